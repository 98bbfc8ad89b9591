#include "base/ellipsoid_surface.hpp"

#include <cmath>
#include <numbers>

namespace bodice::inline v0_1::fitting {

double surface_area(const geometry::Vec3& r) {
  constexpr double p = 1.6075;
  const double a = std::pow(r.x(), p), b = std::pow(r.y(), p), c = std::pow(r.z(), p);
  return 4.0 * std::numbers::pi * std::pow((a * b + a * c + b * c) / 3.0, 1.0 / p);
}

std::vector<SurfaceProbe> probe_surface(const geometry::Ellipsoid& e, int count) {
  std::vector<SurfaceProbe> probes;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, turn = 2.399963229728653 * i;
    const double ring = std::sqrt(1.0 - z * z);
    const geometry::Vec3 u(ring * std::cos(turn), ring * std::sin(turn), z);
    const double area = e.radii.prod() * u.cwiseQuotient(e.radii).norm() * 4.0 * std::numbers::pi / count;
    probes.push_back({e.center + e.axes * e.radii.cwiseProduct(u), area});
  }
  return probes;
}

}  // namespace bodice::fitting
