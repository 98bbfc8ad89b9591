#include "collider/mended_ellipsoid.hpp"

#include <Eigen/LU>

#include <bodice/geometry/similarity.hpp>

namespace bodice::inline v0_1::collision {

std::string_view mend(geometry::Ellipsoid& e) noexcept {
  constexpr double kExact = 1e-6;  // the kernels' floats do not resolve what is below
  if (!e.center.allFinite() || !e.axes.allFinite() || !e.radii.allFinite()) return "is not finite";
  if (!(e.radii.minCoeff() > 0.0)) return "has a radius that is not above zero";
  const double skew = (e.axes.transpose() * e.axes - geometry::Mat3::Identity()).cwiseAbs().maxCoeff();
  if (skew <= kExact && e.axes.determinant() > 0.0) return {};
  const geometry::Similarity found = geometry::similarity_of(e.axes);
  if (!found.refusal.empty()) return found.refusal;
  e.axes = found.rotation;
  e.radii *= found.scale;
  return {};
}

}  // namespace bodice::collision
