#include "items.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bodice::fitting {
namespace {

bool wanted(std::uint32_t parts, body::Part part) {
  return (parts >> static_cast<int>(part)) & 1u;
}

/// The part of most of a triangle's corners; of the first corner if all differ.
body::Part part_of(const LabelledSkin& skin, const geometry::Triangle& t) {
  return skin.part[t[1]] == skin.part[t[2]] ? skin.part[t[1]] : skin.part[t[0]];
}

void add_item(Items& items, const Vec3& where, double weight, std::array<Index, 3> encloses, bool is_skin,
              body::Part part) {
  items.where.push_back(where);
  items.weight.push_back(weight);
  items.encloses.push_back(encloses);
  items.is_skin.push_back(is_skin);
  items.part.push_back(part);
}

/// The part of the skin vertex nearest to each anchor, found on a coarse hash-free grid of sorted cells.
class NearestPart {
 public:
  explicit NearestPart(const LabelledSkin& skin) : skin_(skin) {
    box_ = geometry::bounding_box(skin.mesh.positions);
    cell_ = std::max(box_.size().maxCoeff() / kCells, 1e-300);
    start_.assign(kCells * kCells * kCells + 1, 0);
    std::vector<std::uint32_t> cell(skin.mesh.positions.size());
    for (std::size_t v = 0; v < cell.size(); ++v) ++start_[(cell[v] = flat(at(skin.mesh.positions[v]))) + 1];
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    vertex_.resize(cell.size());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::uint32_t v = 0; v < cell.size(); ++v) vertex_[next[cell[v]]++] = v;
  }

  body::Part operator()(const Vec3& p) const {
    const std::array<int, 3> home = at(p);
    double best = std::numeric_limits<double>::infinity();
    body::Part part = body::Part::kHead;
    for (int ring = 0; ring < kCells; ++ring) {
      if (best <= (ring - 1) * cell_ * (ring - 1) * cell_ && ring > 0) break;
      scan_ring(home, ring, p, best, part);
    }
    return part;
  }

 private:
  static constexpr int kCells = 32;

  std::array<int, 3> at(const Vec3& p) const {
    std::array<int, 3> c{};
    for (int j = 0; j < 3; ++j)
      c[j] = std::clamp(static_cast<int>((p[j] - box_.low[j]) / cell_), 0, kCells - 1);
    return c;
  }
  static std::uint32_t flat(const std::array<int, 3>& c) {
    return static_cast<std::uint32_t>((c[2] * kCells + c[1]) * kCells + c[0]);
  }

  void scan_ring(const std::array<int, 3>& home, int ring, const Vec3& p, double& best,
                 body::Part& part) const {
    for (int z = std::max(0, home[2] - ring); z <= std::min(kCells - 1, home[2] + ring); ++z)
      for (int y = std::max(0, home[1] - ring); y <= std::min(kCells - 1, home[1] + ring); ++y)
        for (int x = std::max(0, home[0] - ring); x <= std::min(kCells - 1, home[0] + ring); ++x) {
          if (std::max({std::abs(x - home[0]), std::abs(y - home[1]), std::abs(z - home[2])}) != ring)
            continue;
          const std::uint32_t c = flat({x, y, z});
          for (std::uint32_t i = start_[c]; i < start_[c + 1]; ++i) {
            const double d = (skin_.mesh.positions[vertex_[i]] - p).squaredNorm();
            if (d < best) best = d, part = skin_.part[vertex_[i]];
          }
        }
  }

  const LabelledSkin& skin_;
  geometry::Box box_;
  double cell_ = 1.0;
  std::vector<std::uint32_t> start_, vertex_;
};

std::vector<Vec3> part_means(const Items& items, const Region& region) {
  std::array<Vec3, body::kPartCount> sum;
  sum.fill(Vec3::Zero());
  std::array<double, body::kPartCount> weight{};
  for (const Index i : region.items) {
    const int p = static_cast<int>(items.part[i]);
    sum[p] += items.weight[i] * items.where[i];
    weight[p] += items.weight[i];
  }
  std::vector<Vec3> means;
  for (int p = 0; p < body::kPartCount; ++p)
    if (weight[p] > 0.0) means.push_back(sum[p] / weight[p]);
  return means;
}

}  // namespace

Items vertex_items(const LabelledSkin& skin, std::uint32_t parts) {
  Items items;
  items.points = skin.mesh.positions;
  for (Index v = 0; v < skin.part.size(); ++v)
    if (wanted(parts, skin.part[v])) add_item(items, items.points[v], 1.0, {v, v, v}, true, skin.part[v]);
  return items;
}

Items solid_items(const LabelledSkin& skin, std::uint32_t parts, std::span<const Vec3> anchors) {
  Items items;
  items.points = skin.mesh.positions;
  double area = 0.0;
  for (std::size_t t = 0; t < skin.mesh.triangles.size(); ++t) {
    const body::Part part = part_of(skin, skin.mesh.triangles[t]);
    if (!wanted(parts, part)) continue;
    const geometry::TriMesh& m = skin.mesh;
    const double twice_area = geometry::area_vector(m, t).norm();
    area += twice_area;
    add_item(items, (m.corner(t, 0) + m.corner(t, 1) + m.corner(t, 2)) / 3.0, twice_area, m.triangles[t],
             true, part);
  }
  // Skin and interior weigh the same, whatever their resolutions.
  const NearestPart nearest(skin);
  const std::size_t first = items.where.size();
  for (const Vec3& a : anchors) {
    const body::Part part = nearest(a);
    if (!wanted(parts, part)) continue;
    const Index id = static_cast<Index>(items.points.size());
    items.points.push_back(a);
    add_item(items, a, 1.0, {id, id, id}, false, part);
  }
  const double count = static_cast<double>(items.where.size() - first);
  for (std::size_t i = first; i < items.where.size(); ++i) items.weight[i] = area / count;
  return items;
}

std::vector<Region> make_regions(const Items& items) {
  Region torso;
  torso.torso = true;
  std::array<Region, body::kPartCount> limbs;
  for (Index i = 0; i < items.where.size(); ++i) {
    Region& home = body::is_torso(items.part[i]) ? torso : limbs[static_cast<int>(items.part[i])];
    home.items.push_back(i);
  }
  std::vector<Region> regions;
  if (!torso.items.empty()) regions.push_back(std::move(torso));
  for (Region& limb : limbs)
    if (!limb.items.empty()) regions.push_back(std::move(limb));
  for (Region& region : regions) region.seeds = part_means(items, region);
  return regions;
}

}  // namespace bodice::fitting
