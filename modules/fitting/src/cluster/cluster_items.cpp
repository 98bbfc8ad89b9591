#include "cluster/cluster_items.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

/// The part of most of a triangle's corners, or of the first corner if all differ.
body::Part part_of(const LabeledSkin& skin, const geometry::Triangle& t) {
  return skin.part[t[1]] == skin.part[t[2]] ? skin.part[t[1]] : skin.part[t[0]];
}

constexpr int kTorso = static_cast<int>(body::Part::kTorsoUL);  // names the region of all six torso parts
constexpr int kLeastForSixSeeds = 20;  // ellipsoids of the body; with fewer the torso starts as one cluster

/// The part that names the region of each part.
using Homes = std::array<int, body::kAllPartCount>;

/// The homes of all parts, joined until the parts that occur have at most `most` regions.
Homes homes(const std::array<bool, body::kAllPartCount>& occurs, int most) {
  using body::Part;
  constexpr std::array<std::pair<Part, Part>, 9> kJoin = {{{Part::kForearmL, Part::kUpperArmL},
                                                           {Part::kForearmR, Part::kUpperArmR},
                                                           {Part::kCalfL, Part::kThighL},
                                                           {Part::kCalfR, Part::kThighR},
                                                           {Part::kHead, Part::kTorsoUL},
                                                           {Part::kUpperArmL, Part::kTorsoUL},
                                                           {Part::kUpperArmR, Part::kTorsoUL},
                                                           {Part::kThighL, Part::kTorsoUL},
                                                           {Part::kThighR, Part::kTorsoUL}}};
  Homes home{};
  for (int p = 0; p < body::kAllPartCount; ++p) home[p] = body::is_torso(static_cast<Part>(p)) ? kTorso : p;
  const auto regions = [&] {
    std::uint32_t used = 0;
    for (int p = 0; p < body::kAllPartCount; ++p)
      if (occurs[p]) used |= 1u << home[p];
    return std::popcount(used);
  };
  for (const auto& [from, to] : kJoin) {
    if (regions() <= most) break;
    std::replace(home.begin(), home.end(), static_cast<int>(from), static_cast<int>(to));
  }
  // The parts of a thing are sorted by area: the smallest ones join the largest.
  for (int p = body::kAllPartCount - 1; p > static_cast<int>(Part::kThing) && regions() > most; --p)
    home[p] = static_cast<int>(Part::kThing);
  return home;
}

std::vector<Vec3> part_means(const Items& items, const Region& region) {
  std::array<Vec3, body::kAllPartCount> sum;
  sum.fill(Vec3::Zero());
  std::array<double, body::kAllPartCount> weight{};
  for (const Index i : region.items) {
    const int p = static_cast<int>(items.part[i]);
    sum[p] += items.weight[i] * items.where[i];
    weight[p] += items.weight[i];
  }
  std::vector<Vec3> means;
  for (int p = 0; p < body::kAllPartCount; ++p)
    if (weight[p] > 0.0) means.push_back(sum[p] / weight[p]);
  return means;
}

}  // namespace

Items vertex_items(const LabeledSkin& skin) {
  Items items;
  items.where = skin.mesh.positions;
  items.weight.assign(skin.part.size(), 1.0);
  items.part.assign(skin.part.begin(), skin.part.end());
  return items;
}

Items triangle_items(const engine::Context& context, const LabeledSkin& skin) {
  constexpr std::size_t kGrain = 2048;
  Items items;
  const geometry::TriMesh& m = skin.mesh;
  const std::size_t count = m.triangles.size();
  items.points = m.positions;
  items.encloses = m.triangles;
  items.where.resize(count);
  items.weight.resize(count);
  items.triangle.resize(count);
  items.part.resize(count);
  engine::parallel_for(context, count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      items.where[t] = (m.corner(t, 0) + m.corner(t, 1) + m.corner(t, 2)) / 3.0;
      items.weight[t] = geometry::area_vector(m, t).norm();
      items.triangle[t] = static_cast<Index>(t);
      items.part[t] = part_of(skin, m.triangles[t]);
    }
  });
  return items;
}

std::vector<Region> make_regions(const Items& items, int most) {
  std::array<bool, body::kAllPartCount> occurs{};
  for (const body::Part part : items.part) occurs[static_cast<int>(part)] = true;
  const Homes home = homes(occurs, most);
  std::array<Region, body::kAllPartCount> all;
  for (Index i = 0; i < items.where.size(); ++i)
    all[home[static_cast<int>(items.part[i])]].items.push_back(i);
  for (int p = 0; p < body::kAllPartCount; ++p)
    if (occurs[p]) all[home[p]].parts |= 1u << p;
  std::vector<Region> regions;
  for (int p = 0; p < body::kAllPartCount; ++p) {
    Region& region = all[p];
    if (region.items.empty()) continue;
    region.torso = p == kTorso;
    region.name = region.torso ? "torso" : body::name(static_cast<body::Part>(p));
    region.seeds = part_means(items, region);
    if (!region.torso || most < kLeastForSixSeeds) region.seeds.resize(1);
    regions.push_back(std::move(region));
  }
  return regions;
}

}  // namespace bodice::fitting
