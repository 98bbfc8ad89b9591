#include "model/check.hpp"

#include "binding/check_binding.hpp"

#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace bodice::inline v0_1::proxy {
namespace {

using Fault = std::optional<engine::Error>;

constexpr double kAxesTolerance = 1e-6;
// Sizes and positions outside this range would leave the range of float or double in queries.
constexpr double kLargest_m = 1e15;
constexpr double kSmallestRadius_m = 1e-15;
constexpr double kSmallestUnit_m = 1e-12;
constexpr double kLargestUnit_m = 1e12;

engine::Error fault(std::string what) {
  return {engine::ErrorCode::kInvalidArgument, "Body proxy: " + std::move(what) + ".",
          "Fit the body again, or repair the file."};
}

/// Whether least <= value <= most; false for NaN.
bool bounded(double value, double least, double most) {
  return value >= least && value <= most;
}

Fault check_header(const BodyProxy::Data& data) {
  if (static_cast<unsigned>(data.tier) > static_cast<unsigned>(Tier::kRelief))
    return fault("the tier is not one of the four");
  if (!bounded(data.stature_m, 0.0, kLargest_m)) return fault("the stature is negative or not finite");
  if (!bounded(std::abs(data.margin_m), 0.0, kLargest_m)) return fault("the margin is not finite");
  if (!bounded(data.frame.meters_per_unit, kSmallestUnit_m, kLargestUnit_m))
    return fault("the unit is not a length between 1e-12 m and 1e12 m");
  if (static_cast<unsigned>(data.frame.up) > static_cast<unsigned>(geometry::Axis::kZ))
    return fault("the up axis is not x, y or z");
  if (data.ellipsoids.size() > kMaxEllipsoids)
    return fault("there are more than " + std::to_string(kMaxEllipsoids) + " ellipsoids");
  if (data.texels.size() > kMaxReliefTexels)
    return fault("there are more than " + std::to_string(kMaxReliefTexels) + " relief texels");
  return std::nullopt;
}

Fault check_ellipsoid(const ProxyEllipsoid& e, const std::string& which) {
  if (static_cast<int>(e.part) >= body::kAllPartCount) return fault(which + " has an unknown part");
  if (e.bone < kNoBone) return fault(which + " has a negative bone");
  for (int k = 0; k < 3; ++k) {
    if (!bounded(std::abs(e.shape.center[k]), 0.0, kLargest_m))
      return fault(which + " has a center that is not finite");
    if (!bounded(e.shape.radii[k], kSmallestRadius_m, kLargest_m))
      return fault(which + " has a radius that is not positive and finite");
  }
  const geometry::Mat3& r = e.shape.axes;
  const double skew = (r.transpose() * r - geometry::Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!r.allFinite() || !(skew <= kAxesTolerance)) return fault(which + " has axes that are not orthonormal");
  if (!(r.determinant() > 0.0)) return fault(which + " has left-handed axes");
  return std::nullopt;
}

Fault check_table(const ReliefTable& table, std::size_t texels, const std::string& which) {
  const std::uint64_t n = table.nodes_per_side;
  if (n == 1 || n > static_cast<std::uint64_t>(kMaxReliefNodes))
    return fault(which + " has a relief table of " + std::to_string(n) + " nodes a side");
  if (table.first_texel + n * n > texels)
    return fault(which + " has a relief table that ends beyond the texels");
  for (float value : {table.h_scale_m, table.h_offset_m, table.a_scale, table.a_offset})
    if (!bounded(std::abs(static_cast<double>(value)), 0.0, kLargest_m))
      return fault(which + " has a relief scale that is not finite");
  return std::nullopt;
}

}  // namespace

std::optional<engine::Error> find_fault(const BodyProxy::Data& data) {
  if (Fault header = check_header(data)) return header;
  if (!data.relief.empty() && data.relief.size() != data.ellipsoids.size())
    return fault("there are " + std::to_string(data.relief.size()) + " relief tables for " +
                 std::to_string(data.ellipsoids.size()) + " ellipsoids");
  for (std::size_t i = 0; i < data.ellipsoids.size(); ++i) {
    const std::string which = "ellipsoid " + std::to_string(i);
    if (Fault bad = check_ellipsoid(data.ellipsoids[i], which)) return bad;
    if (data.relief.empty()) continue;
    if (Fault bad = check_table(data.relief[i], data.texels.size(), which)) return bad;
  }
  if (data.binding)
    if (const std::string what = binding_fault(*data.binding, data); !what.empty()) return fault(what);
  return std::nullopt;
}

}  // namespace bodice::proxy
