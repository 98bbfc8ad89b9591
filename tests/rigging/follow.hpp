// A found rig that follows the joints of a true one, and how far its skin then is from the true skin.
#pragma once

#include <functional>
#include <optional>

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/rig/rig.hpp>

namespace posed {

/// What a true joint does between two poses: the rotation of its surroundings, and where it carries a point.
using Motion = std::function<std::optional<bodice::rig::Affine>(std::string_view found_joint)>;

/// The found rig's skin with every joint turned as the true joint is that `motion` gives for its name (or as
/// its parent, where it gives none), and the root carried along. Bones keep their own lengths.
std::vector<bodice::geometry::Vec3> follow(const bodice::rig::Rig& found,
                                           const std::vector<bodice::geometry::Vec3>& skin,
                                           const Motion& motion);

struct SkinError {
  double mean_mm = 0.0, p95_mm = 0.0, max_mm = 0.0;
};

/// Distance of each point to the true posed skin.
SkinError skin_error(const std::vector<bodice::geometry::Vec3>& points,
                     const bodice::geometry::TriMesh& truth);

}  // namespace posed
