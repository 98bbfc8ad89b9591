// Poses of any skeleton by the parts of the skin that its joints carry: limbs bent toward directions.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <bodice/binding/bind.hpp>
#include <bodice/body/part.hpp>

namespace bodice::inline v0_1::binding {

/// A bend of one limb: its part turns toward a direction, unless it is far from the straight one.
struct Bend {
  body::Part part;
  Vec3 toward;
  double degrees;
  body::Part straight_from;  ///< a straight limb goes on with the direction of this part; the same: any
};

/// What limbs are bent along: the body's own directions in the bind pose.
struct Directions {
  Vec3 up, front, left;
};

/// The joints that carry a skin's limbs.
class Limbs {
 public:
  /// `part` (#V) gives the skin that a joint must carry; names of joints do not matter.
  Limbs(const SkinnedBody& body, std::span<const body::Part> part);

  const Directions& directions() const { return directions_; }
  /// Skinning matrices (#J) with the limbs bent; nothing if none is bent. Limbs that are bent already stay,
  /// and so do limbs of which no joint is found.
  std::optional<std::vector<rig::Affine>> bent(std::span<const Bend> bends) const;

 private:
  Vec3 centroid(body::Part of) const { return centroid_[static_cast<std::size_t>(of)]; }

  const rig::Skeleton& skeleton_;
  std::vector<std::optional<std::size_t>> joint_;  // #parts
  std::vector<Vec3> centroid_;                     // #parts
  Directions directions_;
};

}  // namespace bodice::binding
