// Based on: Fernand Meyer. Topographic distance and watershed lines. 1994. Differs: floods of depths in three
// dimensions, and walls only where limbs may be apart.
#include "walls/known_walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "check/thighs.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using geometry::Vec3;

enum Limb : signed char { kNone = -1, kTrunk, kArmLeft, kArmRight, kLegLeft, kLegRight };

class Floods {
 public:
  /// `crotch`: below it there is no trunk.
  Floods(const geometry::FieldGrid& depth, const Fold* crotch)
      : grid_(depth), crotch_(crotch), limb_(depth.value.size(), kNone) {}

  Vec3 position(std::size_t node) const {
    const auto [nx, ny, nz] = grid_.nodes;
    const Vec3 at(static_cast<double>(node % nx), static_cast<double>(node / nx % ny),
                  static_cast<double>(node / nx / ny));
    return grid_.low + grid_.cell_m * at;
  }

  /// Nodes within a distance of a bone are of its limb.
  void seed(Limb limb, const Vec3& from, const Vec3& to, double radius) {
    bones_.push_back({limb, from, to});
    geometry::Box box;
    box.extend(from), box.extend(to);
    std::array<std::size_t, 3> first, last;
    for (int axis = 0; axis < 3; ++axis) {
      const double most = static_cast<double>(grid_.nodes[static_cast<std::size_t>(axis)]) - 1.0;
      const auto node = [&](double at) {
        return static_cast<std::size_t>(std::clamp((at - grid_.low[axis]) / grid_.cell_m, 0.0, most));
      };
      first[static_cast<std::size_t>(axis)] = node(box.low[axis] - radius);
      last[static_cast<std::size_t>(axis)] = node(box.high[axis] + radius);
    }
    for (std::size_t z = first[2]; z <= last[2]; ++z)
      for (std::size_t y = first[1]; y <= last[1]; ++y)
        for (std::size_t x = first[0]; x <= last[0]; ++x)
          if (const std::size_t node = grid_.index(x, y, z); from_bone(position(node), from, to) < radius)
            take(node, limb);
  }

  void run() {
    while (!front_.empty()) {
      const std::size_t node = front_.top().second;
      front_.pop();
      for_neighbors(node, [&](std::size_t next) { take(next, limb_[node]); });
    }
  }

  Limb of(std::size_t node) const { return limb_[node]; }

  /// Nodes of the legs go to the one with the nearer bone: of thighs that have grown together in a stride,
  /// the floods meet far from the middle, and paths along such a wall are too long.
  void split_legs() {
    for (std::size_t node = 0; node < limb_.size(); ++node) {
      if (!is_leg(limb_[node])) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Bone& bone : bones_) {
        const double distance = is_leg(bone.limb) ? from_bone(position(node), bone.from, bone.to) : nearest;
        if (distance < nearest) nearest = distance, limb_[node] = bone.limb;
      }
    }
  }

  /// Inside nodes are not at the border, so that all six neighbors are in the grid.
  template <class Visit>
  void for_neighbors(std::size_t node, Visit&& visit) const {
    const std::size_t row = grid_.nodes[0], layer = row * grid_.nodes[1];
    for (const std::size_t step : {std::size_t{1}, row, layer}) visit(node - step), visit(node + step);
  }

 private:
  struct Bone {
    Limb limb;
    Vec3 from, to;
  };

  static bool is_leg(Limb limb) { return limb == kLegLeft || limb == kLegRight; }
  static double from_bone(const Vec3& p, const Vec3& from, const Vec3& to) {
    const Vec3 bone = to - from;
    const double along = std::clamp((p - from).dot(bone) / std::max(bone.squaredNorm(), 1e-300), 0.0, 1.0);
    return (p - from - along * bone).norm();
  }
  void take(std::size_t node, Limb limb) {
    if (limb_[node] != kNone || !(grid_.value[node] > 0.0F) || at_border(node)) return;
    if (limb == kTrunk && crotch_ && (position(node) - crotch_->at).dot(crotch_->inward) < 0.0) return;
    limb_[node] = limb;
    front_.push({grid_.value[node], node});
  }
  bool at_border(std::size_t node) const {
    const auto [nx, ny, nz] = grid_.nodes;
    const std::size_t x = node % nx, y = node / nx % ny, z = node / nx / ny;
    return x == 0 || y == 0 || z == 0 || x + 1 == nx || y + 1 == ny || z + 1 == nz;
  }

  const geometry::FieldGrid& grid_;
  const Fold* crotch_;
  std::vector<Limb> limb_;
  std::vector<Bone> bones_;
  std::priority_queue<std::pair<float, std::size_t>> front_;
};

/// Where a thigh begins, from the perineum; fractions of the stature.
constexpr double kThighAside = 0.05, kThighAbove = 0.03;
/// How near to its bone all is of an arm, and of a leg or the trunk; fractions of the stature.
constexpr double kNearArm = 0.02, kNearBone = 0.02;

void seed_limbs(const Anatomy& found, Floods& floods) {
  const auto at = [&](LandmarkId left, int side = 0) {
    return found.landmarks[static_cast<std::size_t>(body::of_side(left, side))].position;
  };
  const Vec3 neck = at(LandmarkId::kNeck), perineum = at(LandmarkId::kPerineum);
  const Vec3 left = (at(LandmarkId::kArmpitL, 0) - at(LandmarkId::kArmpitL, 1)).normalized();
  const double of_arm = kNearArm * found.stature_m, of_leg = kNearBone * found.stature_m;
  floods.seed(kTrunk, neck, perineum + 0.35 * (neck - perineum), of_leg);
  for (int side = 0; side < 2; ++side) {
    const Limb arm = side == 0 ? kArmLeft : kArmRight, leg = side == 0 ? kLegLeft : kLegRight;
    const Vec3 elbow = at(LandmarkId::kElbowL, side), knee = at(LandmarkId::kKneeL, side);
    floods.seed(arm, 0.5 * (at(LandmarkId::kArmpitL, side) + at(LandmarkId::kShoulderL, side)), elbow,
                of_arm);
    floods.seed(arm, elbow, at(LandmarkId::kWristL, side), of_arm);
    const double aside = side == 0 ? kThighAside : -kThighAside;
    floods.seed(leg, perineum + found.stature_m * (aside * left + kThighAbove * found.up), knee, of_leg);
    floods.seed(leg, knee, at(LandmarkId::kAnkleL, side), of_leg);
  }
}

const Fold* fold_of(LandmarkId id, const std::vector<Fold>& folds) {
  const auto it = std::ranges::find(folds, id, &Fold::id);
  return it == folds.end() ? nullptr : &*it;
}

/// The fold that two limbs meet in; null for what does not meet in one.
const Fold* fold_between(Limb a, Limb b, const std::vector<Fold>& folds) {
  const auto either = [&](Limb limb) { return a == limb || b == limb; };
  if (either(kArmLeft))
    if (const Fold* fold = fold_of(LandmarkId::kArmpitL, folds)) return fold;
  if (either(kArmRight)) return fold_of(LandmarkId::kArmpitR, folds);
  return either(kLegLeft) && either(kLegRight) ? fold_of(LandmarkId::kPerineum, folds) : nullptr;
}

}  // namespace

std::vector<char> known_walls(const geometry::FieldGrid& depth, const Anatomy& found,
                              const std::vector<Fold>& folds) {
  const bool sits = std::ranges::min(thigh_cosines(found)) < kNotBent;
  Floods floods(depth, sits ? nullptr : fold_of(LandmarkId::kPerineum, folds));
  seed_limbs(found, floods);
  floods.run();
  floods.split_legs();
  std::vector<char> wall(depth.value.size(), 0);
  for (std::size_t node = 0; node < wall.size(); ++node) {
    if (floods.of(node) == kNone) continue;
    floods.for_neighbors(node, [&](std::size_t next) {
      if (!(floods.of(next) > floods.of(node))) return;
      const Fold* fold = fold_between(floods.of(node), floods.of(next), folds);
      if (fold && (floods.position(next) - fold->at).dot(fold->inward) < 0.0) wall[next] = 1;
    });
  }
  return wall;
}

}  // namespace bodice::anatomy
