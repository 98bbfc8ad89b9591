// Based on: Luc Vincent, Pierre Soille. Watersheds in digital spaces: an efficient algorithm based on
// immersion simulations. 1991. Differs: basins join unless the neck between them is shallow, slice by slice.
#include "walls/limb_tracks.hpp"

#include <map>
#include <utility>

namespace bodice::inline v0_1::anatomy {
namespace {

/// What is nowhere deeper than so many cells is no limb: fingers, noise.
constexpr double kLeastDepth = 1.2;
/// A lobe that is this much larger than the one below it is another one.
constexpr double kWider = 1.4;

struct Lobe {
  std::size_t slice = 0;
  int area = 0, track = kNoTrack;
};

/// The lobes of all slices, and the one of each node.
struct Lobes {
  std::vector<Lobe> all;  ///< in the order of slices
  std::vector<int> of_node;

  Lobe& operator[](int b) { return all[static_cast<std::size_t>(b)]; }
};

/// The lobes of one slice while they grow from their deepest nodes on.
class Flood {
 public:
  Flood(const Slices& slices, std::size_t slice, double neck)
      : slices_(slices),
        slice_(slice),
        neck_(static_cast<float>(neck)),
        least_(static_cast<float>(kLeastDepth * slices.cell())),
        root_of_(slices.plane(), kNoTrack) {
    // In a mesh that is no body, nodes at the border may be inside, too; they have no neighbors on one side.
    for (std::size_t i = 0; i < slices.plane(); ++i)
      if (depth(i) > 0.0F && slices.holds(static_cast<long>(slices.u(i)), static_cast<long>(slices.v(i))))
        inside_.push_back(i);
    std::sort(inside_.begin(), inside_.end(), [&](std::size_t a, std::size_t b) {
      return depth(a) != depth(b) ? depth(a) > depth(b) : a < b;
    });
    for (const std::size_t i : inside_) add(i);
  }

  void number(Lobes& lobes) const {
    std::vector<int> number_of(parent_.size(), kNoTrack);
    for (const std::size_t i : inside_) {
      int& number = number_of[static_cast<std::size_t>(root(root_of_[i]))];
      if (number == kNoTrack) number = static_cast<int>(lobes.all.size()), lobes.all.push_back({slice_});
      lobes.of_node[slices_.node(slice_, i)] = number;
      ++lobes[number].area;
    }
  }

 private:
  float depth(std::size_t i) const { return slices_.depth(slice_, i); }
  float& peak(int r) { return peak_[static_cast<std::size_t>(r)]; }
  int root(int r) const {
    while (parent_[static_cast<std::size_t>(r)] != r) r = parent_[static_cast<std::size_t>(r)];
    return r;
  }

  /// Lobes that meet at a node become one, unless the node is a neck; it goes to its deepest neighbor's.
  void add(std::size_t i) {
    int mine = kNoTrack;
    std::size_t deepest = i;
    slices_.for_neighbors(i, true, [&](std::size_t next) {
      if (root_of_[next] == kNoTrack) return;
      if (deepest == i || depth(next) > depth(deepest)) deepest = next;
      int other = root(root_of_[next]);
      if (mine == kNoTrack) mine = other;
      if (mine == other) return;
      if (peak(other) > peak(mine)) std::swap(mine, other);
      if (depth(i) >= neck_ * peak(other) || peak(other) < least_)
        parent_[static_cast<std::size_t>(other)] = mine;
    });
    if (mine == kNoTrack) {
      mine = static_cast<int>(parent_.size());
      parent_.push_back(mine), peak_.push_back(depth(i));
    }
    root_of_[i] = deepest == i ? mine : root_of_[deepest];
  }

  const Slices& slices_;
  std::size_t slice_;
  float neck_, least_;
  std::vector<std::size_t> inside_;
  std::vector<int> root_of_, parent_;
  std::vector<float> peak_;
};

/// For each lobe the one of the slice above and the one below with the most nodes in common.
struct Links {
  std::vector<int> up, down;
};

Links link(const Slices& slices, const Lobes& lobes) {
  std::map<std::pair<int, int>, int> common;
  for (std::size_t k = 0; k + 1 < slices.count(); ++k)
    for (std::size_t i = 0; i < slices.plane(); ++i) {
      const int low = lobes.of_node[slices.node(k, i)], high = lobes.of_node[slices.node(k + 1, i)];
      if (low != kNoTrack && high != kNoTrack) ++common[{low, high}];
    }
  const std::size_t count = lobes.all.size();
  Links links{std::vector<int>(count, kNoTrack), std::vector<int>(count, kNoTrack)};
  std::vector<int> most_up(count), most_down(count);
  for (const auto& [pair, nodes] : common) {
    const auto low = static_cast<std::size_t>(pair.first), high = static_cast<std::size_t>(pair.second);
    if (nodes > most_up[low]) most_up[low] = nodes, links.up[low] = pair.second;
    if (nodes > most_down[high]) most_down[high] = nodes, links.down[high] = pair.first;
  }
  return links;
}

}  // namespace

LimbTracks limb_tracks(const Slices& slices, double neck, double most_area) {
  Lobes lobes{{}, std::vector<int>(slices.count() * slices.plane(), kNoTrack)};
  for (std::size_t k = 0; k < slices.count(); ++k) Flood(slices, k, neck).number(lobes);
  const Links links = link(slices, lobes);
  LimbTracks out;
  for (int b = 0; b < static_cast<int>(lobes.all.size()); ++b) {
    Lobe& lobe = lobes[b];
    const int below = links.down[static_cast<std::size_t>(b)];
    const bool goes_on = below != kNoTrack && links.up[static_cast<std::size_t>(below)] == b &&
                         (lobe.area < most_area || lobe.area < kWider * lobes[below].area);
    if (goes_on) {
      lobe.track = lobes[below].track;
    } else {
      lobe.track = static_cast<int>(out.tracks.size());
      out.tracks.push_back({.first = lobe.slice, .below = below == kNoTrack ? kNoTrack : lobes[below].track});
    }
    out[lobe.track].last = lobe.slice;
    out[lobe.track].nodes += lobe.area;
  }
  for (std::size_t b = 0; b < lobes.all.size(); ++b) {
    Track& track = out[lobes.all[b].track];
    if (track.last == lobes.all[b].slice && links.up[b] != kNoTrack) track.above = lobes[links.up[b]].track;
  }
  out.of_node = std::move(lobes.of_node);
  for (int& of : out.of_node)
    if (of != kNoTrack) of = lobes[of].track;
  return out;
}

}  // namespace bodice::anatomy
