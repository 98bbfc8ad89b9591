#include "walls/limb_follow.hpp"

#include <algorithm>
#include <cmath>

#include "walls/limb_kind.hpp"
#include "walls/upper_arm.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

// Lengths are shares of the body's height, areas of slices shares of its square.
constexpr double kGap = 0.10;   ///< a limb that is lost for no longer goes on
constexpr double kHand = 0.11;  ///< from the wrist to the fingertips
/// Two footprints with this share of the smaller one in common are of one limb.
constexpr double kSame = 0.3;
/// A limb goes on in what is at most so many times as thick or as thin.
constexpr double kThicker = 2.0;
/// An arm that is lost in the trunk goes on from below the wrist, and is a forearm or a hand up to there.
/// With a bent elbow the hand begins in the air, and may do so higher.
constexpr double kWristsBelow = 0.5, kBentWristsBelow = 0.6, kForearmFrom = 0.42, kForearmArea = 0.003,
                 kLeastHandArea = 0.00004;
/// It goes on up to the armpit. Bent arms are parted higher: copies of them lack fingers, so that the path
/// from hand to foot over a lower armpit is as short as one over a weld.
constexpr double kArmpit = 0.735, kBentArmpit = 0.76;

class Follower {
 public:
  Follower(const Slices& slices, LimbTracks& limbs) : slices_(slices), limbs_(limbs) {}

  void run() {
    const auto count = static_cast<int>(limbs_.tracks.size());
    for (int t = 0; t < count; ++t) join_end(t);
    for (int t = 0; t < count; ++t) bridge_gap(t);
    for (int t = 0; t < count; ++t)
      if (is_lost(limbs_[t])) follow_to_shoulder(t);
    for (int t = 0; t < count; ++t) follow_hand(t);
  }

 private:
  int& of(std::size_t slice, std::size_t i) { return limbs_.of_node[slices_.node(slice, i)]; }
  int of(std::size_t slice, std::size_t i) const { return limbs_.of_node[slices_.node(slice, i)]; }

  /// The middle of a track's nodes in a slice.
  SlicePoint middle_of(std::size_t slice, int t) const {
    return slices_.middle([&](std::size_t i) { return of(slice, i) == t; });
  }

  void rename(int t, int to) {
    for (std::size_t k = limbs_[t].first; k <= limbs_[t].last; ++k)
      for (std::size_t i = 0; i < slices_.plane(); ++i)
        if (of(k, i) == t) of(k, i) = to;
    limbs_[to].nodes += limbs_[t].nodes;
    limbs_[t].renamed = to;
  }

  /// Whether a track may be a hand or a part of an arm.
  bool is_thin(const Track& t) const {
    return t.renamed == kNoTrack && mean_area(slices_, t) < kArmArea && !is_leg(slices_, t);
  }

  /// A thin track that begins in the air and ends in another thin one is a hand or a finger of that limb.
  void join_end(int t) {
    const Track& end = limbs_[t];
    if (end.below != kNoTrack || end.above == kNoTrack || !is_thin(end) || !is_thin(limbs_[end.above]))
      return;
    Track& limb = limbs_[end.above];
    limb.first = std::min(limb.first, end.first);
    if (limb.below == t) limb.below = kNoTrack;
    rename(t, end.above);
  }

  /// Nodes of a track in its last slice that are of another one in its first, over the fewer of both.
  double shared(int ended, int born) const {
    int both = 0, of_a = 0, of_b = 0;
    for (std::size_t i = 0; i < slices_.plane(); ++i) {
      const bool in_a = of(limbs_[ended].last, i) == ended, in_b = of(limbs_[born].first, i) == born;
      both += in_a && in_b, of_a += in_a, of_b += in_b;
    }
    const int fewer = std::min(of_a, of_b);
    return fewer > 0 ? static_cast<double>(both) / fewer : 0.0;
  }

  bool as_thick(const Track& a, const Track& b) const {
    const double area_a = mean_area(slices_, a), area_b = mean_area(slices_, b);
    return area_a < kThicker * area_b && area_b < kThicker * area_a;
  }

  void bridge_gap(int t) {
    const Track born = limbs_[t];
    if (born.below == kNoTrack || mean_area(slices_, born) > kLegArea) return;
    int best = kNoTrack;
    double most = kSame;
    for (int a = 0; a < t; ++a) {
      const Track& ended = limbs_[a];
      if (ended.renamed != kNoTrack || ended.above == kNoTrack || ended.last >= born.first ||
          ended.last + 1 + slices_.count(kGap) < born.first || !as_thick(ended, born))
        continue;
      if (const double same = shared(a, t); same > most) most = same, best = a;
    }
    if (best == kNoTrack) return;
    rename(t, best);
    const std::size_t low = limbs_[best].last, high = born.first;
    for (std::size_t k = low + 1; k < high; ++k) fill_gap(low, high, k, best);
    limbs_[best].last = born.last, limbs_[best].above = born.above;
  }

  /// A slice between two that have a track gets the footprint of the nearer one, moved to where it would be,
  /// and a node wider.
  void fill_gap(std::size_t low, std::size_t high, std::size_t slice, int t) {
    const SlicePoint from = middle_of(low, t), to = middle_of(high, t);
    const double share = static_cast<double>(slice - low) / static_cast<double>(high - low);
    const std::size_t source = share < 0.5 ? low : high;
    const double part = share < 0.5 ? share : share - 1.0;
    const long by_u = std::lround(part * (to[0] - from[0])), by_v = std::lround(part * (to[1] - from[1]));
    std::vector<std::size_t> found;
    const auto take = [&](std::size_t i) {
      if (of(slice, i) != kNoTrack) found.push_back(i);
    };
    for (std::size_t i = 0; i < slices_.plane(); ++i) {
      if (of(source, i) != t) continue;
      const long u = static_cast<long>(slices_.u(i)) + by_u, v = static_cast<long>(slices_.v(i)) + by_v;
      if (!slices_.holds(u, v)) continue;
      take(slices_.at(u, v));
      slices_.for_neighbors(slices_.at(u, v), false, take);
    }
    for (const std::size_t i : found) of(slice, i) = t;
  }

  bool is_lost(const Track& t) const {
    const double area = mean_area(slices_, t);
    const double most = t.last < slices_.count(kArmpitFrom) ? kForearmArea : kArmArea;
    const bool hand = t.below == kNoTrack;
    const double least = hand ? kLeastHandArea : kLeastSplitArea;
    return t.renamed == kNoTrack && t.above != kNoTrack && !is_short(slices_, t) && !is_leg(slices_, t) &&
           t.first <= slices_.count(hand ? kBentWristsBelow : kWristsBelow) &&
           t.last >= slices_.count(kForearmFrom) && t.last < slices_.count(kArmpit) && area <= most &&
           area >= least;
  }

  /// A hand that begins above the wrists of hanging arms shows a bent elbow.
  void follow_to_shoulder(int t) {
    Track& limb = limbs_[t];
    const bool bent = limb.first > slices_.count(kWristsBelow);
    const std::size_t top = slices_.count(bent ? kBentArmpit : kArmpit);
    const SlicePoint end = middle_of(limb.last, t);
    const auto arm =
        bent ? UpperArm::bent(slices_, limb.last + 1, top, end) : UpperArm::hanging(slices_, limb.last, end);
    if (!arm) return;
    for (std::size_t k = limb.last + 1; k <= top; ++k)
      for (std::size_t i = 0; i < slices_.plane(); ++i)
        if (of(k, i) != kNoTrack && arm->holds(k, i)) of(k, i) = t;
    limb.nodes += kDisk * arm->radius() * arm->radius() * static_cast<double>(top - limb.last);
    limb.last = top;
  }

  /// Nodes of `slice` become those of a track where the nearest node that the slice beside it decides is.
  /// Only those of other tracks that lie beside its footprint do.
  bool carry(std::size_t beside, std::size_t slice, int from, int to) {
    std::vector<int> nearest(slices_.plane(), kNoTrack);
    std::vector<std::size_t> front, next;
    for (std::size_t i = 0; i < slices_.plane(); ++i)
      if (of(slice, i) == from && of(beside, i) != kNoTrack)
        nearest[i] = of(beside, i) == to ? to : from, front.push_back(i);
    for (; !front.empty(); front.swap(next), next.clear())
      for (const std::size_t i : front)
        slices_.for_neighbors(i, false, [&](std::size_t n) {
          if (nearest[n] != kNoTrack || of(slice, n) != from) return;
          nearest[n] = nearest[i];
          next.push_back(n);
        });
    bool any = false;
    for (std::size_t i = 0; i < slices_.plane(); ++i)
      if (nearest[i] == to) of(slice, i) = to, any = true;
    return any;
  }

  bool carry_down(std::size_t slice, int t) {
    std::vector<int> hosts;
    for (std::size_t i = 0; i < slices_.plane(); ++i)
      if (const int host = of(slice, i); of(slice + 1, i) == t && host != kNoTrack && host != t)
        hosts.push_back(host);
    std::sort(hosts.begin(), hosts.end());
    hosts.erase(std::unique(hosts.begin(), hosts.end()), hosts.end());
    bool any = false;
    for (const int host : hosts) any |= carry(slice + 1, slice, host, t);
    return any;
  }

  void follow_hand(int t) {
    Track& arm = limbs_[t];
    if (arm.below == kNoTrack || !is_arm(slices_, arm)) return;
    const std::size_t end = arm.first - std::min(arm.first, slices_.count(kHand));
    while (arm.first > end + 1 && carry_down(arm.first - 1, t)) --arm.first;
  }

  /// Area of a disk with a radius of one, about.
  static constexpr double kDisk = 3.0;
  const Slices& slices_;
  LimbTracks& limbs_;
};

}  // namespace

void follow_limbs(const Slices& slices, LimbTracks& limbs) {
  Follower(slices, limbs).run();
}

}  // namespace bodice::anatomy
