#include "mesh/cage_builder.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::synth {

Region shared_region(Region a, Region b) {
  if (a == b) return a;
  if (is_digit(a) && is_digit(b)) return region_of_side(Region::kArmL, side_of(a));
  return std::min(a, b);
}

void CageBuilder::band(const Loop& from, const Loop& to, Region region, std::span<const int> open) {
  const int n = static_cast<int>(from.size());
  for (int i = 0; i < n; ++i) {
    if (std::find(open.begin(), open.end(), i) != open.end()) continue;
    const int next = (i + 1) % n;
    quad(from[i], from[next], to[next], to[i], region);
  }
}

Loop CageBuilder::extrude(const Loop& from, const std::function<Vec3(int)>& position, Region region,
                          std::span<const int> open) {
  Loop to;
  for (int i = 0; i < static_cast<int>(from.size()); ++i) to.push_back(add(position(i)));
  band(from, to, region, open);
  return to;
}

void CageBuilder::lid(const Loop& loop, int columns, int rows, const Vec3& bulge, Region region) {
  std::vector<int> grid((columns + 1) * (rows + 1));
  const auto at = [&](int c, int r) -> int& { return grid[r * (columns + 1) + c]; };
  int next = 0;
  for (int c = 0; c < columns; ++c) at(c, 0) = loop[next++];
  for (int r = 0; r < rows; ++r) at(columns, r) = loop[next++];
  for (int c = columns; c > 0; --c) at(c, rows) = loop[next++];
  for (int r = rows; r > 0; --r) at(0, r) = loop[next++];
  for (int r = 1; r < rows; ++r)
    for (int c = 1; c < columns; ++c) {
      const double s = static_cast<double>(c) / columns, t = static_cast<double>(r) / rows;
      const Vec3 across = (1.0 - s) * position(at(0, r)) + s * position(at(columns, r));
      const Vec3 down = (1.0 - t) * position(at(c, 0)) + t * position(at(c, rows));
      at(c, r) = add(0.5 * (across + down) + bulge);
    }
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) quad(at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1), region);
}

void CageBuilder::orient() {
  // The first quad's winding spreads over shared edges; the sign of the volume then decides the orientation.
  std::map<std::pair<int, int>, std::vector<int>> quads_of_edge;
  for (int q = 0; q < static_cast<int>(cage_.quads.size()); ++q)
    for (int k = 0; k < 4; ++k)
      quads_of_edge[std::minmax(cage_.quads[q][k], cage_.quads[q][(k + 1) % 4])].push_back(q);
  const auto runs = [&](int q, int a, int b) {
    for (int k = 0; k < 4; ++k)
      if (cage_.quads[q][k] == a && cage_.quads[q][(k + 1) % 4] == b) return true;
    return false;
  };
  std::vector<bool> done(cage_.quads.size(), false);
  std::vector<int> front = {0};
  done[0] = true;
  while (!front.empty()) {
    const int q = front.back();
    front.pop_back();
    for (int k = 0; k < 4; ++k) {
      const int a = cage_.quads[q][k], b = cage_.quads[q][(k + 1) % 4];
      for (const int other : quads_of_edge[std::minmax(a, b)]) {
        if (done[other]) continue;
        if (runs(other, a, b)) std::reverse(cage_.quads[other].begin(), cage_.quads[other].end());
        done[other] = true;
        front.push_back(other);
      }
    }
  }
  double volume = 0.0;
  for (const Cage::Quad& q : cage_.quads) {
    const Vec3 &a = position(q[0]), &b = position(q[1]), &c = position(q[2]), &d = position(q[3]);
    volume += a.dot(b.cross(c)) + a.dot(c.cross(d));
  }
  if (volume < 0.0)
    for (Cage::Quad& q : cage_.quads) std::reverse(q.begin(), q.end());
}

void CageBuilder::assign_regions() {
  std::vector<bool> seen(cage_.positions.size(), false);
  cage_.region.assign(cage_.positions.size(), Region::kTrunk);
  for (std::size_t q = 0; q < cage_.quads.size(); ++q)
    for (const int v : cage_.quads[q]) {
      cage_.region[v] = seen[v] ? shared_region(cage_.region[v], cage_.quad_region[q]) : cage_.quad_region[q];
      seen[v] = true;
    }
  for (const int v : crotch_) cage_.region[v] = Region::kCrotch;
}

Cage CageBuilder::finish() {
  orient();
  assign_regions();
  return std::move(cage_);
}

}  // namespace bodice::synth
