// Based on: William J. Schroeder, Jonathan A. Zarge, William E. Lorensen. Decimation of Triangle Meshes.
// 1992. (the distance of a removed vertex to the planes around it) Based on: Tamal K. Dey, Herbert
// Edelsbrunner, Sumanta Guha, Dmitry V. Nekhayev. Topology Preserving Edge Contraction. 1999. (the link
// condition)
#include "repair/merging.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace bodice::inline v0_1::geometry {
namespace {

/// The least cosine between a triangle's normals before and after.
constexpr double kLeastTurnBack = 0.5;
/// The least height of a triangle over its longest side; an equilateral one has .87. Flatter ones may stay
/// so.
constexpr double kLeastSlender = 0.19;
/// A vertex with fewer triangles is no fan that can lose two of them.
constexpr int kFewestTriangles = 4;
/// A vertex does not get more triangles than this.
constexpr int kMostAfter = 10;

/// The square of a triangle's longest side.
double longest2(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

}  // namespace

bool Merging::Fan::has(Index vertex) const {
  return std::find(neighbor.begin(), neighbor.begin() + neighbors, vertex) != neighbor.begin() + neighbors;
}

Merging::Merging(const TriMesh& mesh, const ThinOptions& options)
    : positions_(mesh.positions),
      options_(options),
      triangles_(mesh.triangles),
      parent_(mesh.positions.size()),
      head_(mesh.positions.size(), kNoIndex),
      next_(3 * mesh.triangles.size()),
      error_(mesh.positions.size(), 0.0) {
  std::iota(parent_.begin(), parent_.end(), Index{0});
  for (Index corner = 0; corner < next_.size(); ++corner) {
    Index& head = head_[triangles_[corner / 3][corner % 3]];
    next_[corner] = head;
    head = corner;
  }
}

/// Visits the corners at a vertex until a visit returns false, and forgets those of triangles that are gone.
template <class Visit>
void Merging::for_each_corner(Index vertex, Visit&& visit) {
  for (Index* link = &head_[vertex]; *link != kNoIndex;) {
    const Index corner = *link;
    if (triangles_[corner / 3][0] == kNoIndex) {
      *link = next_[corner];
      continue;
    }
    if (!visit(corner)) return;
    link = &next_[corner];
  }
}

bool Merging::add_neighbor(Index vertex, Fan& fan) const {
  const auto begin = fan.neighbor.begin(), end = begin + fan.neighbors;
  const auto at = std::find(begin, end, vertex);
  if (at != end) return ++fan.uses[static_cast<std::size_t>(at - begin)] <= 2;
  if (fan.neighbors == kMostTriangles) return false;
  fan.neighbor[static_cast<std::size_t>(fan.neighbors)] = vertex;
  fan.uses[static_cast<std::size_t>(fan.neighbors++)] = 1;
  return true;
}

/// Whether the triangles around a vertex are a closed fan within its block.
bool Merging::find_fan(Index vertex, Fan& fan) {
  bool simple = true;
  for_each_corner(vertex, [&](Index corner) {
    const Triangle& t = triangles_[corner / 3];
    simple = fan.triangles < kMostTriangles;
    if (simple) fan.corner[static_cast<std::size_t>(fan.triangles++)] = corner;
    for (std::size_t k = 0; k < 3 && simple; ++k)
      if (k != corner % 3)
        simple = t[k] != vertex && block_[t[k]] == block_[vertex] && add_neighbor(t[k], fan);
    return simple;
  });
  return simple && fan.triangles >= kFewestTriangles && fan.triangles == fan.neighbors;
}

/// Whether the two have no neighbor in common but those across the two triangles between them.
bool Merging::keeps_topology(Index vertex, Index into, const Fan& fan) {
  std::array<Index, 2> across{kNoIndex, kNoIndex};
  std::size_t shared = 0;
  for (int i = 0; i < fan.triangles; ++i) {
    const Triangle& t = triangles_[fan.corner[static_cast<std::size_t>(i)] / 3];
    if (std::find(t.begin(), t.end(), into) == t.end()) continue;
    if (shared == 2) return false;
    for (const Index v : t)
      if (v != vertex && v != into) across[shared] = v;
    ++shared;
  }
  int others = 0;
  bool keeps = shared == 2;
  for_each_corner(into, [&](Index corner) {
    const Triangle& t = triangles_[corner / 3];
    if (std::find(t.begin(), t.end(), vertex) != t.end()) return true;
    ++others;
    for (const Index v : t) keeps = keeps && (v == into || v == across[0] || v == across[1] || !fan.has(v));
    return keeps;
  });
  return keeps && others + fan.triangles - 2 <= kMostAfter;
}

/// Whether the triangles of the fan may have their corner at `into`; `error`: how far off they are then.
bool Merging::keeps_shape(Index vertex, Index into, const Fan& fan, double& error) const {
  const Vec3 &from = positions_[vertex], &to = positions_[into];
  for (int i = 0; i < fan.triangles; ++i) {
    const Index corner = fan.corner[static_cast<std::size_t>(i)];
    const Triangle& t = triangles_[corner / 3];
    if (std::find(t.begin(), t.end(), into) != t.end()) continue;
    const Vec3 &b = positions_[t[(corner % 3 + 1) % 3]], &c = positions_[t[(corner % 3 + 2) % 3]];
    const Vec3 before = (b - from).cross(c - from), after = (b - to).cross(c - to);
    const double size = after.norm(), size_before = before.norm();
    if (!(before.dot(after) > kLeastTurnBack * size_before * size)) return false;
    const double long2 = longest2(to, b, c);
    if (size < kLeastSlender * long2 && size * longest2(from, b, c) < size_before * long2) return false;
    error = std::max(error, error_[vertex] + std::abs((from - to).dot(after)) / size);
    if (error > options_.tolerance_m) return false;
  }
  return true;
}

void Merging::apply(Index vertex, Index into, const Fan& fan) {
  Index& head = head_[into];
  for (int i = 0; i < fan.triangles; ++i) {
    const Index corner = fan.corner[static_cast<std::size_t>(i)];
    Triangle& t = triangles_[corner / 3];
    if (std::find(t.begin(), t.end(), into) != t.end()) {
      t[0] = kNoIndex;
      continue;
    }
    t[corner % 3] = into;
    next_[corner] = head;
    head = corner;
  }
  head_[vertex] = kNoIndex;
  parent_[vertex] = into;
}

bool Merging::merge(Index vertex) {
  Fan fan;
  if (!find_fan(vertex, fan)) return false;
  std::array<std::pair<double, Index>, kMostTriangles> near;
  int count = 0;
  for (int i = 0; i < fan.neighbors; ++i) {
    const Index v = fan.neighbor[static_cast<std::size_t>(i)];
    const double length2 = (positions_[v] - positions_[vertex]).squaredNorm();
    if (length2 < options_.edge_m * options_.edge_m) near[static_cast<std::size_t>(count++)] = {length2, v};
  }
  std::sort(near.begin(), near.begin() + count);
  for (int i = 0; i < count; ++i) {
    const Index into = near[static_cast<std::size_t>(i)].second;
    double error = error_[into];
    if (!keeps_shape(vertex, into, fan, error) || !keeps_topology(vertex, into, fan)) continue;
    apply(vertex, into, fan);
    error_[into] = error;
    return true;
  }
  return false;
}

Index Merging::final_vertex(Index vertex) {
  Index last = vertex;
  while (parent_[last] != last) last = parent_[last];
  while (parent_[vertex] != last) vertex = std::exchange(parent_[vertex], last);
  return last;
}

ThinnedSurface Merging::finish() {
  ThinnedSurface out;
  out.vertex_of_input.assign(parent_.size(), kNoIndex);
  for (Index v = 0; v < parent_.size(); ++v) {
    if (is_merged(v)) continue;
    out.vertex_of_input[v] = static_cast<Index>(out.mesh.positions.size());
    out.mesh.positions.push_back(positions_[v]);
    out.kept.push_back(v);
  }
  for (Index v = 0; v < parent_.size(); ++v)
    if (is_merged(v)) out.vertex_of_input[v] = out.vertex_of_input[final_vertex(v)];
  out.triangle_of_input.assign(triangles_.size(), kNoIndex);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (triangles_[t][0] == kNoIndex) continue;
    out.triangle_of_input[t] = static_cast<Index>(out.mesh.triangles.size());
    Triangle& corners = out.mesh.triangles.emplace_back(triangles_[t]);
    for (Index& v : corners) v = out.vertex_of_input[v];
  }
  return out;
}

}  // namespace bodice::geometry
