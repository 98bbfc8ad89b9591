// Based on: Gregory M. Nielson. Dual marching cubes. 2004. (a vertex for each sheet of surface in a cell)
// Differs: the sheets of the 256 cases are found from the faces of the cell, and vertices are means of edge
// crossings.
#include <bodice/geometry/contour.hpp>

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::geometry {
namespace {

/// The corners at the ends of the 12 edges of a cell; corner bits are x, y, z. Edges 0-3 run along x, 4-7
/// along y, 8-11 along z.
constexpr std::array<std::array<int, 2>, 12> kEnds = {
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
/// The four corners of each face, in a circle.
constexpr std::array<std::array<int, 4>, 6> kFaces = {
    {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};

constexpr int edge_between(int a, int b) {
  for (int e = 0; e < 12; ++e)
    if ((kEnds[e][0] == a && kEnds[e][1] == b) || (kEnds[e][0] == b && kEnds[e][1] == a)) return e;
  return -1;
}

/// The sheet of surface that crosses each edge of a cell, -1 where none does.
struct Sheets {
  std::array<std::int8_t, 12> of_edge{};
  int count = 0;
};

/// On a face, the two edges at an inside corner belong to one sheet; with two inside corners side by side,
/// the edges at their far ends do.
Sheets sheets_of(int inside) {
  const auto in = [&](int corner) { return (inside >> corner & 1) != 0; };
  std::array<int, 12> root;
  for (int e = 0; e < 12; ++e) root[e] = e;
  const auto unite = [&](int a, int b) {
    const int from = root[b], to = root[a];
    for (int& r : root)
      if (r == from) r = to;
  };
  for (const auto& face : kFaces) {
    int open = -1;  // an edge where the circle enters the inside
    for (int k = 0; k < 8; ++k) {
      const int a = face[k % 4], b = face[(k + 1) % 4];
      if (!in(a) && in(b)) open = edge_between(a, b);
      if (in(a) && !in(b) && open >= 0) unite(open, edge_between(a, b)), open = -1;
    }
  }
  Sheets sheets;
  std::array<int, 12> number;
  number.fill(-1);
  for (int e = 0; e < 12; ++e) {
    const bool crossed = in(kEnds[e][0]) != in(kEnds[e][1]);
    if (crossed && number[root[e]] < 0) number[root[e]] = sheets.count++;
    sheets.of_edge[e] = static_cast<std::int8_t>(crossed ? number[root[e]] : -1);
  }
  return sheets;
}

const std::array<Sheets, 256>& all_sheets() {
  static const std::array<Sheets, 256> table = [] {
    std::array<Sheets, 256> all;
    for (int inside = 0; inside < 256; ++inside) all[static_cast<std::size_t>(inside)] = sheets_of(inside);
    return all;
  }();
  return table;
}

/// Makes the surface of one grid.
class Contour {
 public:
  explicit Contour(const FieldGrid& grid) : grid_(grid), first_(grid.value.size(), kNoIndex) {}

  TriMesh run() {
    for_each_cell([&](const Cell& cell) { add_vertices(cell); });
    for_each_cell([&](const Cell& cell) { add_quads(cell); });
    return std::move(mesh_);
  }

 private:
  struct Cell {
    std::array<std::size_t, 3> at;
    int inside;
  };

  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    for (std::size_t z = 0; z + 1 < grid_.nodes[2]; ++z)
      for (std::size_t y = 0; y + 1 < grid_.nodes[1]; ++y)
        for (std::size_t x = 0; x + 1 < grid_.nodes[0]; ++x)
          if (const int inside = corners(x, y, z); inside != 0 && inside != 255)
            visit(Cell{{x, y, z}, inside});
  }

  int corners(std::size_t x, std::size_t y, std::size_t z) const {
    int inside = 0;
    for (int c = 0; c < 8; ++c) inside |= (value(x, y, z, c) < 0.0f) << c;
    return inside;
  }

  float value(std::size_t x, std::size_t y, std::size_t z, int corner) const {
    return grid_.value[grid_.index(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1))];
  }

  void add_vertices(const Cell& cell) {
    const Sheets& sheets = all_sheets()[static_cast<std::size_t>(cell.inside)];
    const auto [x, y, z] = cell.at;
    first_[grid_.index(x, y, z)] = static_cast<Index>(mesh_.positions.size());
    std::array<Vec3, 4> sum;
    std::array<int, 4> count{};
    sum.fill(Vec3::Zero());
    for (int e = 0; e < 12; ++e) {
      if (sheets.of_edge[e] < 0) continue;
      const auto sheet = static_cast<std::size_t>(sheets.of_edge[e]);
      const auto [a, b] = kEnds[e];
      const double va = static_cast<double>(value(x, y, z, a)), vb = static_cast<double>(value(x, y, z, b));
      const double share = va / (va - vb);
      for (int k = 0; k < 3; ++k) {
        const double from = a >> k & 1, to = b >> k & 1;
        sum[sheet][k] += from + share * (to - from);
      }
      ++count[sheet];
    }
    const Vec3 corner(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    for (int s = 0; s < sheets.count; ++s)
      mesh_.positions.push_back(grid_.low + grid_.cell_m * (corner + sum[s] / count[s]));
  }

  /// The quads across the three edges at the low corner of a cell: each joins the four cells around it.
  void add_quads(const Cell& cell) {
    const auto [x, y, z] = cell.at;
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      if (cell.at[u] == 0 || cell.at[v] == 0) continue;
      const bool low = cell.inside & 1, high = cell.inside >> (1 << axis) & 1;
      if (low == high) continue;
      std::array<Index, 4> quad;
      constexpr std::array<std::array<int, 2>, 4> kAround = {{{1, 1}, {0, 1}, {0, 0}, {1, 0}}};
      for (int k = 0; k < 4; ++k) {
        std::array<std::size_t, 3> at = {x, y, z};
        at[u] -= static_cast<std::size_t>(kAround[k][0]);
        at[v] -= static_cast<std::size_t>(kAround[k][1]);
        const int from = kAround[k][0] << u | kAround[k][1] << v;
        quad[k] = vertex(at, edge_between(from, from | 1 << axis));
      }
      if (!low) std::swap(quad[1], quad[3]);
      push(quad);
    }
  }

  Index vertex(const std::array<std::size_t, 3>& at, int edge) const {
    const Sheets& sheets = all_sheets()[static_cast<std::size_t>(corners(at[0], at[1], at[2]))];
    return first_[grid_.index(at[0], at[1], at[2])] + static_cast<Index>(sheets.of_edge[edge]);
  }

  /// Two triangles, cut along the shorter diagonal.
  void push(const std::array<Index, 4>& q) {
    const auto length = [&](Index a, Index b) {
      return (mesh_.positions[a] - mesh_.positions[b]).squaredNorm();
    };
    if (length(q[0], q[2]) <= length(q[1], q[3])) {
      mesh_.triangles.push_back({q[0], q[1], q[2]});
      mesh_.triangles.push_back({q[0], q[2], q[3]});
    } else {
      mesh_.triangles.push_back({q[0], q[1], q[3]});
      mesh_.triangles.push_back({q[1], q[2], q[3]});
    }
  }

  const FieldGrid& grid_;
  TriMesh mesh_;
  std::vector<Index> first_;  ///< #nodes: the first vertex of the cell at this low corner
};

}  // namespace

TriMesh contour(const engine::Context& context, const FieldGrid& grid) {
  context.checkpoint();
  return Contour(grid).run();
}

}  // namespace bodice::geometry
