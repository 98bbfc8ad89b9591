#include "skin/small_components.hpp"

#include <algorithm>
#include <array>

namespace bodice::inline v0_1::anatomy {
namespace {

using body::Part;
using geometry::Index;

using Tally = std::array<std::size_t, body::kPartCount>;

/// Vertices joined by edges between equal parts, by path-halving union-find.
class Patches {
 public:
  Patches(const Skin& skin, const std::vector<Part>& part) : root_(part.size()), size_(part.size(), 1) {
    for (std::size_t v = 0; v < root_.size(); ++v) root_[v] = static_cast<Index>(v);
    for (const auto& [a, b] : skin.edges.ends)
      if (part[a] == part[b]) join(a, b);
  }
  Index of(Index v) {
    while (root_[v] != v) v = root_[v] = root_[root_[v]];
    return v;
  }
  std::size_t size(Index v) { return size_[of(v)]; }

 private:
  void join(Index a, Index b) {
    a = of(a);
    b = of(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    root_[b] = a;
    size_[a] += size_[b];
  }
  std::vector<Index> root_;
  std::vector<std::size_t> size_;
};

/// The part that a patch takes that is cut off from the rest of its own. Where the borders of hip and waist
/// meet at the flank, half a seat is: it is the other half's before it is a thigh's.
Part taken_by(Part own, const Tally& around) {
  const Part other_half = body::mirrored(own);
  if (body::is_torso(own) && around[static_cast<int>(other_half)] > 0) return other_half;
  return static_cast<Part>(std::max_element(around.begin(), around.end()) - around.begin());
}

}  // namespace

void absorb_small_components(const Skin& skin, std::vector<Part>& part) {
  Patches patches(skin, part);
  std::array<Index, body::kPartCount> largest;
  largest.fill(geometry::kNoIndex);
  for (std::size_t v = 0; v < part.size(); ++v) {
    if (skin.component[v] != 0) continue;
    Index& best = largest[static_cast<int>(part[v])];
    const Index root = patches.of(static_cast<Index>(v));
    if (best == geometry::kNoIndex || patches.size(root) > patches.size(best)) best = root;
  }
  const auto island = [&](Index v) { return patches.of(v) != largest[static_cast<int>(part[v])]; };
  std::vector<std::pair<Index, Tally>> around;  // islands by root, sorted, with the parts that touch them
  std::vector<Index> slot(part.size(), geometry::kNoIndex);
  const auto touch = [&](Index v, Index neighbor) {
    if (skin.component[v] != 0 || part[v] == part[neighbor] || !island(v) || island(neighbor)) return;
    Index& s = slot[patches.of(v)];
    if (s == geometry::kNoIndex) {
      s = static_cast<Index>(around.size());
      around.push_back({patches.of(v), Tally{}});
    }
    ++around[s].second[static_cast<int>(part[neighbor])];
  };
  for (const auto& [a, b] : skin.edges.ends) {
    touch(a, b);
    touch(b, a);
  }
  std::vector<Part> result = part;
  for (std::size_t v = 0; v < part.size(); ++v) {
    const Index s = slot[patches.of(static_cast<Index>(v))];
    if (s != geometry::kNoIndex) result[v] = taken_by(part[v], around[s].second);
  }
  part = std::move(result);
}

}  // namespace bodice::anatomy
