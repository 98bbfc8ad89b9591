#include "cover/cover_pieces.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "base/closest_point_batch.hpp"
#include "base/scaling.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

using geometry::Index;
using geometry::Triangle;

constexpr int kTriangleCuts = 3;  // a triangle is cut at most so many times
constexpr double kFine_mm = 2.0;  // triangles with shorter edges are not cut, so that fine meshes keep theirs

/// Appends the nearest ellipsoid of each position beyond those already in `nearest`.
void add_nearest(const Scaling& scaling, std::span<const geometry::Vec3> positions,
                 std::span<const geometry::Ellipsoid> ellipsoids, std::vector<std::uint32_t>& nearest) {
  const std::size_t known = nearest.size(), n = positions.size() - known;
  std::array<std::vector<float>, 3> at;
  for (int j = 0; j < 3; ++j)
    for (const geometry::Vec3& p : positions.subspan(known))
      at[j].push_back(static_cast<float>((p[j] - scaling.origin[j]) * scaling.scale));
  std::vector<float> least(n, std::numeric_limits<float>::infinity()), d(n);
  nearest.resize(positions.size(), 0);
  for (std::uint32_t k = 0; k < ellipsoids.size(); ++k) {
    batch_distances(FloatEllipsoid(scaling.in(ellipsoids[k])), {n, at[0].data(), at[1].data(), at[2].data()},
                    d.data());
    for (std::size_t i = 0; i < n; ++i)
      if (d[i] < least[i]) least[i] = d[i], nearest[known + i] = k;
  }
}

double longest_edge(std::span<const geometry::Vec3> positions, const Triangle& t) {
  return std::max({(positions[t[0]] - positions[t[1]]).norm(), (positions[t[1]] - positions[t[2]]).norm(),
                   (positions[t[2]] - positions[t[0]]).norm()});
}

/// Cuts triangles in four at the middles of their edges; neighboring triangles share these middles.
class TriangleCutter {
 public:
  explicit TriangleCutter(std::vector<geometry::Vec3>& positions) : positions_(positions) {}

  void cut(const Triangle& t, std::vector<Triangle>& pieces) {
    const Index ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    pieces.insert(pieces.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
  }

 private:
  Index middle(Index a, Index b) {
    const auto [found, fresh] = middles_.emplace(std::minmax(a, b), static_cast<Index>(positions_.size()));
    if (fresh) positions_.push_back(0.5 * (positions_[a] + positions_[b]));
    return found->second;
  }

  std::vector<geometry::Vec3>& positions_;
  std::map<std::pair<Index, Index>, Index> middles_;
};

}  // namespace

CoverPieces cut_at_creases(const LabeledSkin& skin, std::span<const Index> triangles,
                           std::span<const geometry::Ellipsoid> ellipsoids) {
  CoverPieces pieces{{skin.mesh.positions, {}}};
  for (const Index t : triangles) pieces.mesh.triangles.push_back(skin.mesh.triangles[t]);
  auto& [positions, rest] = pieces.mesh;
  const Scaling scaling(skin);
  TriangleCutter cutter(positions);
  std::vector<std::uint32_t> nearest;
  for (int cut = 0; cut < kTriangleCuts; ++cut) {
    add_nearest(scaling, positions, ellipsoids, nearest);
    std::vector<Triangle> next;
    for (const Triangle& t : rest) {
      const bool across = nearest[t[0]] != nearest[t[1]] || nearest[t[1]] != nearest[t[2]];
      if (across && longest_edge(positions, t) > kFine_mm * scaling.mm())
        cutter.cut(t, next);
      else
        next.push_back(t);
    }
    rest = std::move(next);
  }
  return pieces;
}

}  // namespace bodice::fitting
