#pragma once

#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/geometry/noise.hpp>

namespace bodice::inline v0_1::io {

/// Whether a skin has many more vertices than a fit needs.
bool is_overfine(const geometry::TriMesh& skin);

/// Takes vertices out of such a skin, with its noise, a standard deviation in its unit or 0, and returns the
/// warning about it. `surface` is of the skin's mesh.
engine::Warning thin_skin(const engine::Context& context, const geometry::RoughSurface& surface, double noise,
                          geometry::RepairedMesh& skin);

}  // namespace bodice::io
