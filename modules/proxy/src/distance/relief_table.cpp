#include <algorithm>
#include <cmath>

#include <bodice/proxy/proxy_distance.hpp>

namespace bodice::inline v0_1::proxy {
namespace {

double sign(double value) {
  return value < 0.0 ? -1.0 : 1.0;
}

}  // namespace

ReliefReach relief_reach(double stature_m) {
  constexpr double kReferenceStature_m = 1.70;
  constexpr ReliefReach kReference{0.030, 0.030, 0.003};
  const double scale = stature_m > 0.0 ? stature_m / kReferenceStature_m : 1.0;
  return {kReference.in_m * scale, kReference.out_m * scale, kReference.blend_m * scale};
}

std::array<double, 2> octahedral_map(const Vec3& w) {
  const double s = w.cwiseAbs().sum();
  // The center of an ellipsoid that is far away rounds to its own surface, where there is no direction.
  if (!(s > 0.0)) return {0.0, 0.0};
  const double x = w.x() / s, y = w.y() / s;
  if (w.z() >= 0.0) return {x, y};
  return {(1.0 - std::abs(y)) * sign(x), (1.0 - std::abs(x)) * sign(y)};
}

Vec3 octahedral_direction(double x, double y) {
  const double z = 1.0 - std::abs(x) - std::abs(y);
  if (z >= 0.0) return Vec3(x, y, z).normalized();
  return Vec3((1.0 - std::abs(y)) * sign(x), (1.0 - std::abs(x)) * sign(y), z).normalized();
}

TableStencil table_stencil(const Vec3& direction, int nodes_per_side) {
  const auto [x, y] = octahedral_map(direction);
  const double last = nodes_per_side - 1;
  const double u = std::clamp(0.5 * (x + 1.0) * last, 0.0, last);
  const double v = std::clamp(0.5 * (y + 1.0) * last, 0.0, last);
  const int i = std::min(static_cast<int>(u), nodes_per_side - 2);
  const int j = std::min(static_cast<int>(v), nodes_per_side - 2);
  const double s = u - i, t = v - j;
  const auto first = static_cast<std::uint32_t>(j * nodes_per_side + i);
  const auto row = static_cast<std::uint32_t>(nodes_per_side);
  return {{first, first + 1, first + row, first + row + 1},
          {(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t}};
}

}  // namespace bodice::proxy
