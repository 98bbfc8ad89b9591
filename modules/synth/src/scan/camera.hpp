#pragma once

#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::synth {

/// A pinhole camera that looks at a point.
struct Camera {
  geometry::Vec3 position, target;
};

/// For each triangle, the camera that sees it under the least angle from its normal, -1 if none does. A ray
/// leads from the middle of a triangle to a camera; steep views count as unseen. O(#F) rays a camera.
std::vector<int> best_cameras(const engine::Context& context, const geometry::TriMesh& mesh,
                              std::span<const Camera> cameras);

/// Cameras on a circle around the origin of the floor, at changing heights.
std::vector<Camera> ring_of_cameras(int count, double radius_m, double turn_rad, double target_m);

}  // namespace bodice::synth
