// The exact side for proxies with tables. F is not convex, so the certificate is its value at the place
// found: a place that is clear of all plain ellipsoids by more than the tables can add is clear of F, and
// between there and the particle the surface is found by bisection.
#include <cmath>
#include <optional>

#include "exits.hpp"
#include "response.hpp"
#include "tolerances.hpp"

namespace bodice::collision {

using geometry::Vec3;

namespace {

constexpr int kNewtonSteps = 8;
constexpr int kBisections = 40;  // of a metre: to 1e-12
constexpr int kPathSamples = 64;

class ReliefExit {
 public:
  ReliefExit(const UnionField& field, const ReliefTables& relief, double clearance_m, double slack_m)
      : field_(field), relief_(relief), clearance_m_(clearance_m), slack_m_(slack_m) {}

  ReliefSample at(const Vec3& p) const { return relief_sample(field_, relief_, p); }
  bool clear(const Vec3& p) const { return at(p).distance_m >= clearance_m_ + slack_m_; }

  /// Newton along the gradient; nothing if it does not arrive or strays.
  std::optional<Vec3> iterate(const Vec3& p, ReliefSample sample, int& iterations) const {
    const double target = clearance_m_ + slack_m_;
    const double longest = kLongestPush * (target - sample.distance_m);
    Vec3 x = p;
    for (iterations = 1; iterations <= kNewtonSteps; ++iterations) {
      const double norm2 = std::max(sample.gradient.squaredNorm(), 0.25);
      x += (target + slack_m_ - sample.distance_m) / norm2 * sample.gradient;
      sample = at(x);
      if (sample.distance_m >= target) return (x - p).norm() <= longest ? std::optional(x) : std::nullopt;
    }
    return std::nullopt;
  }

  /// The surface between a place that is not clear and one that is; the clear side of it.
  Vec3 surface_between(Vec3 inside, Vec3 outside) const {
    for (int i = 0; i < kBisections; ++i) {
      const Vec3 middle = 0.5 * (inside + outside);
      (clear(middle) ? outside : inside) = middle;
    }
    return outside;
  }

  std::optional<Vec3> along_ray(const Vec3& p, const Vec3& direction) const {
    const auto far =
        exit_along_ray(field_, p, direction, clearance_m_ + slack_m_ + double{relief_.highest_m});
    if (!far) return std::nullopt;
    return surface_between(p, *far);
  }

  /// Where the path from `safe` first meets the surface, to the step of kPathSamples.
  std::optional<Vec3> on_path(const Vec3& safe, const Vec3& p) const {
    if (!clear(safe)) return std::nullopt;
    Vec3 outside = safe;
    for (int i = 1; i <= kPathSamples; ++i) {
      const Vec3 x = safe + (p - safe) * (static_cast<double>(i) / kPathSamples);
      if (!clear(x)) return surface_between(x, outside);
      outside = x;
    }
    return std::nullopt;
  }

 private:
  const UnionField& field_;
  const ReliefTables& relief_;
  double clearance_m_, slack_m_;
};

}  // namespace

ParticleReport resolve_relief(const UnionField& field, const ReliefTables& relief, double clearance_m,
                              const ResolveOptions& options, ParticleState& particle) {
  ParticleReport report;
  const Vec3 p = particle.position;
  const ReliefExit exit(field, relief, clearance_m,
                        kCertificate * (field.size_m() + p.cwiseAbs().maxCoeff()));
  const ReliefSample start = exit.at(p);
  const bool inside = start.distance_m < clearance_m;
  if (!inside && !(particle.has_safe && passes_through(field, particle.safe, p))) return report;
  std::optional<Vec3> x;
  if (inside) {
    report.depth_m = clearance_m - start.distance_m;
    x = exit.iterate(p, start, report.iterations);
    report.fallback = !x;
    if (!x) x = exit.along_ray(p, start.gradient.stableNormalized());
  }
  if (particle.has_safe) {
    const auto entry = exit.on_path(particle.safe, p);
    const bool other_side = entry && (!x || exit.at(*entry).gradient.stableNormalized().dot(
                                                exit.at(*x).gradient.stableNormalized()) < kSlidingCosine);
    if (other_side) x = entry;
    report.wrong_side = other_side;
  }
  report.ellipsoid = start.owner;
  if (!x && !inside) return report;
  // Tables of one ellipsoid's two sides meet in a step inside it: what counts is the place that is stored.
  const bool certain =
      x && exit.at(x->cast<float>().cast<double>()).distance_m >= clearance_m - kReliefCertificate_m;
  report.outcome = certain ? Outcome::kResolved : Outcome::kUnresolved;
  Halfspaces contact;
  contact.add({exit.at(x.value_or(p)).gradient.stableNormalized(), 0.0});
  move(p, x.value_or(p), contact, options, report, particle);
  return report;
}

}  // namespace bodice::collision
