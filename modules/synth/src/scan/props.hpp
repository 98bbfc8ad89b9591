// What stands around a body, as meshes and as distance fields.
#pragma once

#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/contour.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::synth {

/// A box along the axes, with quads of about `edge_m`.
geometry::TriMesh box_mesh(const geometry::Box& box, double edge_m);
double distance_to_box(const geometry::Box& box, const geometry::Vec3& point);

/// Seat, back and four legs of a chair for a body that sits at this point, facing +z.
std::vector<geometry::Box> chair(const geometry::Vec3& seat);

/// A sheet of `side_m` on the floor, with bumps of `noise_m`.
geometry::TriMesh floor_sheet(double side_m, double edge_m, double noise_m, engine::Random& random);

/// A few triangles around a point, as reconstructions leave them in the air.
geometry::TriMesh debris(const geometry::Vec3& around, double size_m, engine::Random& random);

}  // namespace bodice::synth
