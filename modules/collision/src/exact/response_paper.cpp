// Based on: A Human-Clothing Collision Detection Method Based on Ellipsoid Fitting (postprint), section 4,
// eq. (9) and the two stages of its response.
// Differs: a clearance may be kept beyond the surface, along the same ray; without one it is the paper's
// response.
#include <limits>

#include "exact/response.hpp"

namespace bodice::inline v0_1::collision {

using geometry::Vec3;

ParticleReport resolve_paper(const UnionField& field, double clearance_m, ParticleState& particle) {
  ParticleReport report;
  const Vec3 p0 = particle.position;
  double least = std::numeric_limits<double>::infinity();
  const auto push = [&](std::size_t k, const UnionField::Plane&) {
    const geometry::Ellipsoid& shape = field.shape(k);
    const Vec3 surface = geometry::radial_projection(shape, p0);
    const Vec3 ray = (surface - shape.center).normalized();
    const double depth = (surface - p0).dot(ray) + clearance_m;
    if (depth < 0.0) return;
    report.depth_m = std::max(report.depth_m, depth);
    if (depth >= least) return;
    least = depth;
    report.ellipsoid = static_cast<std::uint32_t>(k);
    particle.position = surface + clearance_m * ray;
  };
  field.visit_near(
      p0, [&] { return clearance_m; }, push);
  if (report.ellipsoid == kNoEllipsoid) return report;
  const double to_surface = (particle.position - field.shape(report.ellipsoid).center).norm();
  particle.velocity *= to_surface / (to_surface + least);
  report.iterations = 1;
  const bool outside =
      field.owner(particle.position, clearance_m - 1e-6 * field.size_m()).ellipsoid == kNoEllipsoid;
  report.outcome = outside ? Outcome::kResolved : Outcome::kUnresolved;
  return report;
}

}  // namespace bodice::collision
