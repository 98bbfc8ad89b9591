// The proxy's distance around one particle: the few ellipsoids that matter there are found once, with their
// tangent planes, which bound them from below wherever the particle is moved to.
#pragma once

#include <span>

#include <bodice/geometry/ellipsoid.hpp>

#include "relief_field.hpp"

namespace bodice::collision {

class NearField {
 public:
  /// Values below `below_m` will be exact, others are only told apart from them. `relief` may be null: plain
  /// ellipsoids.
  NearField(const UnionField& field, const ReliefTables* relief, double below_m)
      : field_(field), relief_(relief), below_m_(below_m) {}

  /// What is asked next lies within `radius_m` of `center`; elsewhere is allowed and costs another search.
  void expect(const geometry::Vec3& center, double radius_m);

  /// The distance at x, if it is less than below_m; else no owner and at least below_m.
  ReliefSample at(const geometry::Vec3& x);

  /// One ellipsoid's share of the last answer.
  struct Share {
    double weight;
    ReliefSample sample;
  };
  /// At most kShares of the last answer, that of the owner first. Relief blends them; plain ellipsoids have
  /// one.
  std::span<const Share> shares() const { return {shares_, static_cast<std::size_t>(share_count_)}; }

  /// Least radius of the ellipsoids around; infinite if there are none.
  double shortest_radius_m() const { return shortest_m_; }
  bool has_relief() const { return relief_ != nullptr; }
  int evaluations() const { return evaluations_; }

 private:
  static constexpr int kMost = 48, kShares = 6;

  struct Candidate {
    std::uint32_t ellipsoid;
    double distance_m;      ///< at the centre
    geometry::Vec3 normal;  ///< there
  };
  struct Foot {
    std::uint32_t ellipsoid;
    geometry::NearestPoint at;
  };

  double window_m() const;
  void collect_near(const geometry::Vec3& x);
  void collect_all(const geometry::Vec3& x);
  void meet(std::uint32_t k, const geometry::Vec3& x);
  ReliefSample blend();

  const UnionField& field_;
  const ReliefTables* relief_;
  double below_m_;
  geometry::Vec3 center_ = geometry::Vec3::Zero();
  double radius_m_ = -1.0;
  double shortest_m_ = 0.0;
  Candidate candidates_[kMost];
  int candidate_count_ = 0;
  bool crowded_ = false;  ///< more than kMost: every answer looks at the whole union
  Foot feet_[kMost];
  int foot_count_ = 0;
  double least_m_ = 0.0;
  Share shares_[kShares];
  int share_count_ = 0;
  int evaluations_ = 0;
};

}  // namespace bodice::collision
