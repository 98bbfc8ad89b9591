#include <cmath>

#include <Eigen/Geometry>

#include "curve.hpp"

namespace extremes_bench {

using bodice::geometry::Mat3;
using bodice::geometry::Vec3;

Vec3 Placement::extents_m() const {
  return scale_m * Vec3(1.0, 1.0 / std::sqrt(aspect), 1.0 / aspect);
}

Vec3 Placement::center_m() const {
  return offset * scale_m * Vec3(0.6, -0.64, 0.48);
}

Mat3 Placement::turn() {
  return Eigen::Quaterniond(0.4, 0.8, -0.3, 0.35).normalized().toRotationMatrix();
}

Vec3 Placement::to_world(const Vec3& local_m) const {
  return center_m() + turn() * local_m;
}

}  // namespace extremes_bench
