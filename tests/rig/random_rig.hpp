// Rigs with random poses, for properties that hold for all of them.
#pragma once

#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/rig/rig.hpp>

namespace rig_test {

inline double spread(bodice::engine::Random& random) {
  return 2.0 * random.uniform() - 1.0;
}

inline bodice::rig::Vec3 random_vec3(bodice::engine::Random& random, double size = 1.0) {
  const double x = spread(random), y = spread(random), z = spread(random);
  return size * bodice::rig::Vec3(x, y, z);
}

inline Eigen::Quaterniond random_turn(bodice::engine::Random& random) {
  const double w = spread(random), x = spread(random), y = spread(random), z = spread(random);
  return Eigen::Quaterniond(w + 2.0, x, y, z).normalized();
}

inline bodice::rig::Affine rigid(bodice::engine::Random& random) {
  return bodice::rig::affine(random_turn(random).toRotationMatrix(), random_vec3(random));
}

/// One to six joints of `joints` for each of `vertices`, mended.
inline bodice::rig::SkinWeights random_weights(std::size_t vertices, std::size_t joints,
                                               bodice::engine::Random& random) {
  bodice::rig::Skeleton skeleton;
  skeleton.joints.resize(joints);
  bodice::rig::SkinWeights weights;
  weights.first = {0};
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::size_t count = 1 + random.below(6);
    for (std::size_t k = 0; k < count; ++k) {
      weights.joint.push_back(static_cast<std::uint16_t>(random.below(joints)));
      weights.weight.push_back(static_cast<float>(0.05 + random.uniform()));
    }
    weights.first.push_back(static_cast<std::uint32_t>(weights.joint.size()));
  }
  [[maybe_unused]] const auto mended = mend(weights, skeleton, vertices);
  return weights;
}

inline std::vector<bodice::rig::Vec3> random_points(std::size_t count, bodice::engine::Random& random) {
  std::vector<bodice::rig::Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(random_vec3(random));
  return points;
}

}  // namespace rig_test
