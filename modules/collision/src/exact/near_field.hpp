// The proxy's distance around one particle: the few ellipsoids that matter there are found once, with
// planes that they lie behind, which bound them from below wherever the particle is moved to.
//
// Without relief, and with a blend radius, it is the smooth union: the root F of
//   sum_k max(0, 1 - (d_k - F) / blend)^2 = 1
// which is d where one ellipsoid is near, never above the least d_k, and has a continuous gradient.
#pragma once

#include <span>

#include <bodice/geometry/ellipsoid.hpp>

#include "exact/relief_field.hpp"

namespace bodice::collision {

class NearField {
 public:
  /// Values below `below_m` will be exact, others are only told apart from them. `relief` may be null: plain
  /// ellipsoids, with fillets if `fillet_m` > 0.
  NearField(const UnionField& field, const ReliefTables* relief, double fillet_m, double below_m)
      : field_(field),
        relief_(relief),
        blend_m_(relief ? double{relief->blend_m} : fillet_m),
        bulge_m_(relief ? double{relief->highest_m} : fillet_m),
        below_m_(below_m) {}

  /// How far the surface may lie outside of the plain ellipsoids; zero: it is theirs, convex piece by piece.
  double bulge_m() const { return bulge_m_; }
  double blend_m() const { return blend_m_; }
  bool nonconvex() const { return relief_ != nullptr || blend_m_ > 0.0; }

  /// What is asked next lies within `radius_m` of `center`; elsewhere is allowed and costs another search.
  void prepare(const geometry::Vec3& center, double radius_m);

  /// The distance at x, if it is less than below_m; else no owner and at least below_m.
  ReliefSample at(const geometry::Vec3& x);

  /// One ellipsoid's share of the last answer.
  struct Term {
    double weight;
    ReliefSample sample;
  };
  /// At most kMaxTerms of the last answer, that of the owner first. Relief blends them; plain ellipsoids have
  /// one.
  std::span<const Term> terms() const { return {terms_, static_cast<std::size_t>(term_count_)}; }

  /// Least radius of the ellipsoids around; infinite if there are none.
  double shortest_radius_m() const { return shortest_m_; }
  int evaluations() const { return evaluations_; }

 private:
  static constexpr int kCapacity = 160, kMaxTerms = 6, kRootSteps = 24;

  struct Candidate {
    std::uint32_t ellipsoid;
    UnionField::Plane plane;  ///< at the center
  };
  struct Evaluated {  // without initializers: most of so many are never met
    std::uint32_t ellipsoid;
    double distance_m;
    geometry::Vec3 point, normal;
  };

  double window_m() const;
  void evaluate_candidates(const geometry::Vec3& x);
  void evaluate_all(const geometry::Vec3& x);
  void evaluate(std::uint32_t k, const geometry::Vec3& x);
  ReliefSample blend();
  double smooth_root_m() const;
  double weight_root(double distance_m, double root_m) const;
  ReliefSample corrected_sample(const Evaluated& evaluated) const;

  const UnionField& field_;
  const ReliefTables* relief_;
  double blend_m_, bulge_m_, below_m_;
  geometry::Vec3 center_ = geometry::Vec3::Zero();
  double radius_m_ = -1.0;
  double shortest_m_ = 0.0;
  Candidate candidates_[kCapacity];
  int candidate_count_ = 0;
  bool overflow_ = false;  ///< more than kCapacity: every answer looks at the whole union
  Evaluated evaluated_[kCapacity];
  int evaluated_count_ = 0;
  double least_m_ = 0.0;
  Term terms_[kMaxTerms];
  int term_count_ = 0;
  int evaluations_ = 0;
};

}  // namespace bodice::collision
