#include "walls/limb_walls.hpp"

#include <map>
#include <utility>

#include "walls/limb_follow.hpp"
#include "walls/limb_kind.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

/// Fewer slices show no limbs.
constexpr std::size_t kFewestSlices = 30;
/// Two legs are about as thick, and have no deeper neck between them: above it they are the trunk.
constexpr double kLegsDiffer = 1.4, kLegNeck = 0.8;

class Walls {
 public:
  Walls(const Slices& slices, LimbTracks limbs) : slices_(slices), limbs_(std::move(limbs)) {
    for (const Track& t : limbs_.tracks) {
      arm_.push_back(is_arm(slices, t));
      leg_.push_back(is_leg(slices, t));
    }
    for (std::size_t k = 0; k < slices.count(); ++k) {
      absorb_pieces(k);
      if (leg_neck(k) < kLegNeck) crotch_ = k + 1;
    }
  }

  std::vector<char> mark() const {
    std::vector<char> wall(limbs_.of_node.size(), 0);
    for (std::size_t k = 0; k < slices_.count(); ++k)
      for (std::size_t i = 0; i < slices_.plane(); ++i) {
        const int a = of(k, i);
        if (a == kNoTrack) continue;
        slices_.for_neighbors(i, false, [&](std::size_t n) {
          if (of(k, n) > a && apart(a, of(k, n), k, k)) wall[slices_.node(k, n)] = 1;
        });
        if (k + 1 == slices_.count()) continue;
        const int above = of(k + 1, i);
        if (apart(a, above, k, k + 1)) wall[slices_.node(a > above ? k : k + 1, i)] = 1;
      }
    return wall;
  }

 private:
  int& of(std::size_t slice, std::size_t i) { return limbs_.of_node[slices_.node(slice, i)]; }
  int of(std::size_t slice, std::size_t i) const { return limbs_.of_node[slices_.node(slice, i)]; }
  bool is(const std::vector<bool>& kind, int t) const {
    return t != kNoTrack && kind[static_cast<std::size_t>(t)];
  }

  /// The connected pieces of a slice's tracks other than arms.
  struct Pieces {
    std::vector<int> of_node, area, track, arm;  ///< an arm that the piece touches
  };

  Pieces pieces_of(std::size_t slice) const {
    Pieces pieces{std::vector<int>(slices_.plane(), kNoTrack), {}, {}, {}};
    std::vector<std::size_t> stack;
    for (std::size_t start = 0; start < slices_.plane(); ++start) {
      const int t = of(slice, start);
      if (t == kNoTrack || pieces.of_node[start] != kNoTrack || is(arm_, t)) continue;
      const auto number = static_cast<int>(pieces.area.size());
      pieces.area.push_back(0), pieces.track.push_back(t), pieces.arm.push_back(kNoTrack);
      stack.push_back(start);
      pieces.of_node[start] = number;
      while (!stack.empty()) {
        const std::size_t i = stack.back();
        stack.pop_back();
        ++pieces.area.back();
        slices_.for_neighbors(i, false, [&](std::size_t n) {
          if (of(slice, n) == t && pieces.of_node[n] == kNoTrack)
            pieces.of_node[n] = number, stack.push_back(n);
          if (is(arm_, of(slice, n))) pieces.arm.back() = of(slice, n);
        });
      }
    }
    return pieces;
  }

  /// What an arm cuts off from the rest of a track is of the arm.
  void absorb_pieces(std::size_t slice) {
    const Pieces pieces = pieces_of(slice);
    std::map<int, int> largest;
    for (std::size_t p = 0; p < pieces.area.size(); ++p) {
      int& most = largest[pieces.track[p]];
      most = std::max(most, pieces.area[p]);
    }
    for (std::size_t i = 0; i < slices_.plane(); ++i) {
      if (pieces.of_node[i] == kNoTrack) continue;
      const auto p = static_cast<std::size_t>(pieces.of_node[i]);
      if (pieces.arm[p] != kNoTrack && pieces.area[p] < largest[pieces.track[p]])
        of(slice, i) = pieces.arm[p];
    }
  }

  /// The depth of the neck between two legs as a share of the shallower leg's: 0 where they are apart, 1
  /// where there are not two that are about as thick.
  double leg_neck(std::size_t slice) const {
    std::map<int, std::pair<double, float>> legs;  // area and depth
    float neck = 0.0F;
    for (std::size_t i = 0; i < slices_.plane(); ++i) {
      const int t = of(slice, i);
      if (!is(leg_, t)) continue;
      const float depth = slices_.depth(slice, i);
      auto& [area, deepest] = legs[t];
      ++area, deepest = std::max(deepest, depth);
      slices_.for_neighbors(i, false, [&](std::size_t n) {
        if (of(slice, n) != t && is(leg_, of(slice, n)))
          neck = std::max(neck, std::min(depth, slices_.depth(slice, n)));
      });
    }
    if (legs.size() != 2) return 1.0;
    const auto& [area, depth] = legs.begin()->second;
    const auto& [other_area, other_depth] = legs.rbegin()->second;
    if (area > kLegsDiffer * other_area || other_area > kLegsDiffer * area) return 1.0;
    return static_cast<double>(neck / std::min(depth, other_depth));
  }

  bool apart(int a, int b, std::size_t slice_a, std::size_t slice_b) const {
    if (a == b || a == kNoTrack || b == kNoTrack) return false;
    const bool legs = slice_b < crotch_ && is(leg_, a) && is(leg_, b);
    if (!legs && !is(arm_, a) && !is(arm_, b)) return false;
    return slice_a == slice_b || limbs_[a].last != slice_a || !goes_on_in(a, b);
  }

  /// What ends goes on in what it merges into: in no other limb.
  bool goes_on_in(int ended, int above) const {
    int into = limbs_[ended].above;
    if (into == kNoTrack) return false;
    while (limbs_[into].renamed != kNoTrack) into = limbs_[into].renamed;
    return above == into || (!is(arm_, above) && !is(leg_, above));
  }

  const Slices& slices_;
  LimbTracks limbs_;
  std::vector<bool> arm_, leg_;  ///< by track
  std::size_t crotch_ = 0;       ///< the first slice in which the legs are no longer apart
};

}  // namespace

std::vector<char> limb_walls(const geometry::FieldGrid& depth, double neck) {
  const Slices slices(depth);
  if (slices.count() < kFewestSlices) return {};
  LimbTracks limbs =
      limb_tracks(slices, neck, kLegArea * static_cast<double>(slices.count() * slices.count()));
  follow_limbs(slices, limbs);
  return Walls(slices, std::move(limbs)).mark();
}

}  // namespace bodice::anatomy
