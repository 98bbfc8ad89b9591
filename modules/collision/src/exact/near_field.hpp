// The proxy's distance around one particle in double precision. The few candidates there are found once, each
// with a plane that it lies behind. The planes bound the candidates' distances from below wherever the
// particle is moved to.
//
// Without relief and with a blend radius the distance is that of the smooth union, the root F of
//   sum_k max(0, 1 - (d_k - F) / blend)^2 = 1
// It equals d where one ellipsoid is near, never exceeds the least d_k, and has a continuous gradient.
#pragma once

#include <span>

#include <bodice/geometry/ellipsoid.hpp>

#include "exact/relief_field.hpp"

namespace bodice::inline v0_1::collision {

/// Evaluates the distance of plain ellipsoids, of the smooth union or of relief around one particle.
class NearField {
 public:
  /// Distances below `below_m` are exact; of all others it is only known that they are not below it. `relief`
  /// may be null: the ellipsoids are plain then, with fillets if `fillet_m` > 0.
  NearField(const UnionField& field, const ReliefTables* relief, double fillet_m, double below_m)
      : field_(field),
        relief_(relief),
        blend_m_(relief ? double{relief->blend_m} : fillet_m),
        bulge_m_(relief ? double{relief->highest_m} : fillet_m),
        buried_m_(relief ? double{relief->deepest_m} : 0.0),
        below_m_(below_m) {}

  /// How far the surface may lie outside of the plain ellipsoids, meters. Zero: it consists of their convex
  /// pieces.
  double bulge_m() const { return bulge_m_; }
  double blend_m() const { return blend_m_; }
  bool nonconvex() const { return relief_ != nullptr || blend_m_ > 0.0; }

  /// Finds the candidates for points within `radius_m` of `center`. Points elsewhere are allowed and cost
  /// another search.
  void prepare(const geometry::Vec3& center, double radius_m);

  /// The distance at x if it is less than below_m; otherwise no owner and a distance of at least below_m.
  ReliefSample at(const geometry::Vec3& x);

  /// Contribution of one ellipsoid to the last distance.
  struct Term {
    double weight;
    ReliefSample sample;
  };
  /// At most kMaxTerms contributions to the last distance, the owner's first. Relief blends them; plain
  /// ellipsoids have one.
  std::span<const Term> terms() const { return {terms_, static_cast<std::size_t>(term_count_)}; }

  /// Least radius of the candidates, meters; infinite if there are none.
  double shortest_radius_m() const { return shortest_m_; }
  int evaluations() const { return evaluations_; }

 private:
  static constexpr int kCapacity = 160, kMaxTerms = 6, kRootSteps = 24;

  /// An ellipsoid that may matter, with its bound.
  struct Candidate {
    std::uint32_t ellipsoid;
    UnionField::Plane plane;  ///< its bound, taken at the center
  };
  struct Evaluated {  // has no initializers, since most of the array is never used
    std::uint32_t ellipsoid;
    double distance_m, score_m;
    geometry::Vec3 point, normal;
  };

  double window_m() const;
  void evaluate_candidates(const geometry::Vec3& x);
  void evaluate_all(const geometry::Vec3& x);
  void evaluate(std::uint32_t k, const geometry::Vec3& x);
  ReliefSample blend();
  double smooth_root_m() const;
  double weight_root(double score_m, double root_m) const;
  ReliefSample corrected_sample(const Evaluated& evaluated) const;

  const UnionField& field_;
  const ReliefTables* relief_;
  double blend_m_, bulge_m_, buried_m_, below_m_;
  geometry::Vec3 center_ = geometry::Vec3::Zero();
  double radius_m_ = -1.0;
  double shortest_m_ = 0.0;
  Candidate candidates_[kCapacity];
  int candidate_count_ = 0;
  bool overflow_ = false;  ///< more than kCapacity candidates: every evaluation visits the whole union
  Evaluated evaluated_[kCapacity];
  int evaluated_count_ = 0;
  double least_m_ = 0.0;  ///< least score so far
  Term terms_[kMaxTerms];
  int term_count_ = 0;
  int evaluations_ = 0;
};

}  // namespace bodice::collision
