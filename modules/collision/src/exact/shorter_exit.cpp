// Based on: Alan L. Yuille, Anand Rangarajan. The Concave-Convex Procedure. Neural Computation 15(4), 2003.
// What is outside of all ellipsoids is no convex set, but the half-spaces beyond their tangent planes at the
// closest points of a clear x are clear and contain x. The point of theirs that is closest to p is thus clear
// and no farther from p than x, and replaces x, until nothing is gained.
#include "exact/shorter_exit.hpp"

#include <array>

#include "exact/halfspaces.hpp"
#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

using geometry::Vec3;

namespace {

constexpr int kRounds = 12, kProjections = 32;
/// A round that gains less than this share of the length is the last.
constexpr double kLeastGain = 1e-3;

/// The tangent planes of the ellipsoids within reach at their closest points to x, raised by the clearance.
class TangentPlanes {
 public:
  /// Returns false if the list is too short for all of them.
  bool collect(const UnionField& field, const Vec3& p, const Vec3& x, double clearance_m) {
    size_ = 0;
    bool all = true;
    const double reach_m = (x - p).norm() + clearance_m;
    field.visit_near(
        p, [&] { return reach_m; },
        [&](std::size_t k, const UnionField::Plane&) {
          if (size_ == planes_.size()) return void(all = false);
          const geometry::ClosestPoint at = geometry::closest_point(field.shape(k), x);
          planes_[size_++] = {at.normal, at.normal.dot(x) - (at.signed_distance - clearance_m)};
        });
    return all;
  }
  /// The closest point to p in all half-spaces, by adding the one that is violated most; nothing if that does
  /// not settle.
  std::optional<Vec3> project(const Vec3& p, double tolerance_m) const {
    Halfspaces active;
    Vec3 y = p;
    for (int round = 0; round < kProjections; ++round) {
      const Halfspace* const worst = most_violated(y, tolerance_m);
      if (worst == nullptr) return y;
      if (active.full())
        active.replace(most_idle(active, y), *worst);
      else
        active.add(*worst);
      const auto next = active.closest_point(p, 0.5 * tolerance_m);
      if (!next) return std::nullopt;
      y = *next;
    }
    return std::nullopt;
  }

 private:
  const Halfspace* most_violated(const Vec3& y, double tolerance_m) const {
    const Halfspace* worst = nullptr;
    double most_m = tolerance_m;
    for (std::size_t i = 0; i < size_; ++i)
      if (planes_[i].gap_m(y) > most_m) worst = &planes_[i], most_m = worst->gap_m(y);
    return worst;
  }
  static int most_idle(const Halfspaces& planes, const Vec3& y) {
    int idle = 0;
    for (int i = 1; i < planes.size(); ++i)
      if (planes[i].gap_m(y) < planes[idle].gap_m(y)) idle = i;
    return idle;
  }

  std::array<Halfspace, 96> planes_;
  std::size_t size_ = 0;
};

/// The nearest clear point that the descent from `exit` reaches; `exit` itself where it cannot begin.
Vec3 descend(const UnionField& field, const Vec3& p, const Vec3& exit, double clearance_m) {
  const double tolerance_m = kCertificate * (field.size_m() + p.cwiseAbs().maxCoeff());
  // Planes are kept to a tolerance, so that they are raised by it.
  const double raised_m = clearance_m + tolerance_m;
  Vec3 x = exit;
  TangentPlanes planes;
  for (int round = 0; round < kRounds; ++round) {
    if (!planes.collect(field, p, x, raised_m)) return x;
    const auto y = planes.project(p, tolerance_m);
    if (!y || !((*y - p).norm() < (1.0 - kLeastGain) * (x - p).norm())) return x;
    if (field.owner(*y, clearance_m).ellipsoid != kNoEllipsoid) return x;
    x = *y;
  }
  return x;
}

}  // namespace

std::optional<Vec3> shorter_exit(const UnionField& field, const Vec3& p, const Vec3& exit,
                                 double clearance_m) {
  const Vec3 x = descend(field, p, exit, clearance_m);
  if (!((x - p).norm() < kWorthShortening * (exit - p).norm())) return std::nullopt;
  return x;
}

}  // namespace bodice::collision
