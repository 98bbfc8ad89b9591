#include <bodice/geometry/distance_walk.hpp>

#include <cmath>
#include <limits>

namespace bodice::inline v0_1::geometry {
namespace {

// The share by which a bound on a distance is widened, for what rounding adds to it.
constexpr double kRounding = 1e-12;

}  // namespace

SurfacePoint DistanceWalk::closest_point(const Vec3& query) {
  const double step_m = last_ ? (query - *last_).norm() : std::numeric_limits<double>::quiet_NaN();
  const double reach_m = std::abs(last_m_) + step_m;
  std::optional<SurfacePoint> found;
  if (std::isfinite(reach_m)) found = mesh_->closest_point_within(query, reach_m * (1.0 + kRounding));
  const bool bounded = found.has_value();
  SurfacePoint result = bounded ? *found : mesh_->closest_point(query);
  if (bounded) {
    const bool overlap = step_m < (std::abs(last_m_) + result.signed_distance) * (1.0 - kRounding);
    const bool inside = overlap && mesh_->is_closed() ? last_m_ < 0.0 : mesh_->inside(query);
    if (inside) result.signed_distance = -result.signed_distance;
  }
  last_.reset();
  if (std::isfinite(result.signed_distance)) last_ = query, last_m_ = result.signed_distance;
  return result;
}

double DistanceWalk::least_distance_m(const Vec3& query) const {
  if (!last_ || !mesh_->is_closed()) return -std::numeric_limits<double>::infinity();
  return last_m_ - (query - *last_).norm();
}

}  // namespace bodice::geometry
