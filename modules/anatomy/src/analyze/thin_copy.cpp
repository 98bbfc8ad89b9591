#include "analyze/thin_copy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>

#include "analyze/tips_of_skin.hpp"
#include "analyze/upright_height.hpp"
#include "landmarks/stature.hpp"
#include "walls/known_walls.hpp"
#include "walls/limb_walls.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using geometry::Index;
using geometry::kNoIndex;
using geometry::MeshDistance;
using geometry::TriMesh;
using geometry::Vec3;

/// Cells along a body's height. The height follows from the area, which is 0.63 of the squared height in any
/// pose.
constexpr double kCells = 215.0, kAreaOfHeight = 0.63;
/// The most nodes of the grid; a body in a T pose has two million.
constexpr double kMostNodes = 6e6;
/// Skin within this multiple of the depth, plus a cell, counts as right above the copy.
constexpr double kAbove = 1.25;
/// The penalty of a candidate for a limb's tip, as a share of its distance from the line through the joint.
constexpr double kBeside = 0.5;

/// The part of the copy right below each vertex of the skin; empty where the copy is not right below.
std::vector<std::optional<body::Part>> parts_below(const ThinCopy& thin, const MeshDistance& distance,
                                                   const Anatomy& found, const TriMesh& skin) {
  std::vector<std::optional<body::Part>> parts(skin.positions.size());
  for (std::size_t v = 0; v < parts.size(); ++v) {
    const auto below = distance.closest_point_within(skin.positions[v], kAbove * thin.depth + thin.cell);
    if (!below) continue;
    const geometry::Triangle& corners = thin.mesh.triangles[below->triangle];
    const Index nearest = *std::min_element(corners.begin(), corners.end(), [&](Index a, Index b) {
      return (thin.mesh.positions[a] - below->point).squaredNorm() <
             (thin.mesh.positions[b] - below->point).squaredNorm();
    });
    parts[v] = found.part[nearest];
  }
  return parts;
}

/// Gives each vertex without a part that of the nearest vertex with one, along the skin.
std::vector<body::Part> spread(const TriMesh& skin, const std::vector<std::optional<body::Part>>& known) {
  const geometry::MeshEdges edges = geometry::mesh_edges(skin);
  std::vector<std::vector<Index>> neighbors(skin.positions.size());
  for (const auto& [a, b] : edges.ends) neighbors[a].push_back(b), neighbors[b].push_back(a);
  struct Front {
    double distance;
    Index vertex;
    body::Part part;
    bool operator<(
        const Front& other) const {  // the nearest comes first; among equals the vertex with the lower index
      return distance != other.distance ? distance > other.distance : vertex > other.vertex;
    }
  };
  std::priority_queue<Front> fronts;
  for (Index v = 0; v < known.size(); ++v)
    if (known[v]) fronts.push({0.0, v, *known[v]});
  std::vector<body::Part> parts(known.size(), body::Part::kHead);
  std::vector<bool> done(known.size());
  while (!fronts.empty()) {
    const Front front = fronts.top();
    fronts.pop();
    if (done[front.vertex]) continue;
    done[front.vertex] = true;
    parts[front.vertex] = front.part;
    for (const Index next : neighbors[front.vertex])
      if (!done[next])
        fronts.push({front.distance + (skin.positions[next] - skin.positions[front.vertex]).norm(), next,
                     front.part});
  }
  return parts;
}

/// The vertex of a part that is farthest from a point in the direction of another point.
Index end_of(const TriMesh& skin, const std::vector<body::Part>& parts, body::Part part, const Vec3& from,
             const Vec3& toward) {
  const Vec3 direction = (toward - from).normalized();
  Index best = kNoIndex;
  double most = 0.0;
  for (Index v = 0; v < parts.size(); ++v) {
    if (parts[v] != part) continue;
    const Vec3 offset = skin.positions[v] - from;
    const double along = offset.dot(direction), beside = (offset - along * direction).norm();
    if (best != kNoIndex && along - kBeside * beside <= most) continue;
    most = along - kBeside * beside;
    best = v;
  }
  return best;
}

struct Tip {
  LandmarkId tip, joint;
  body::Part part;
};
constexpr Tip kTopOfHead = {LandmarkId::kCrown, LandmarkId::kNeck, body::Part::kHead};
constexpr std::array<Tip, 4> kTipsOfLimbs = {
    {{LandmarkId::kFingertipL, LandmarkId::kWristL, body::Part::kForearmL},
     {LandmarkId::kFingertipR, LandmarkId::kWristR, body::Part::kForearmR},
     {LandmarkId::kToeL, LandmarkId::kAnkleL, body::Part::kCalfL},
     {LandmarkId::kToeR, LandmarkId::kAnkleR, body::Part::kCalfR}}};

bool lies_on_skin(LandmarkId id) {
  constexpr std::array kOnSkin = {LandmarkId::kNeckFront, LandmarkId::kNeckBack,  LandmarkId::kNeckSideL,
                                  LandmarkId::kNeckSideR, LandmarkId::kShoulderL, LandmarkId::kShoulderR,
                                  LandmarkId::kBustL,     LandmarkId::kBustR};
  return std::find(kOnSkin.begin(), kOnSkin.end(), id) != kOnSkin.end();
}

Index nearest_vertex(const TriMesh& skin, const Vec3& point) {
  Index best = 0;
  for (Index v = 1; v < skin.positions.size(); ++v)
    if ((skin.positions[v] - point).squaredNorm() < (skin.positions[best] - point).squaredNorm()) best = v;
  return best;
}

}  // namespace

std::optional<SampledSkin> SampledSkin::make(const TriMesh& skin, const MeshDistance& distance) {
  const double height = std::sqrt(surface_area(skin) / kAreaOfHeight), cell = height / kCells;
  const geometry::Box box = geometry::bounding_box(skin.positions);
  if (!(cell > 0.0) || box.size().prod() > kMostNodes * std::pow(cell, 3)) return std::nullopt;
  const auto signed_distance = [&distance](const Vec3& p) { return distance.signed_distance(p); };
  return SampledSkin(height, cell, geometry::NodeDistances(signed_distance, box, cell));
}

std::optional<ThinCopy> SampledSkin::thin_copy(const engine::Context& context, double depth_share) {
  ThinCopy thin{{}, depth_share * height_, cell_};
  geometry::FieldGrid grid =
      distances_.sample(context, [&](double distance, const Vec3&) { return distance + thin.depth; });
  for (std::size_t i = 0; i < wall_.size(); ++i)
    if (wall_[i] && grid.value[i] < 0.0F) grid.value[i] = static_cast<float>(0.25 * cell_);
  const TriMesh all = contour(context, grid);
  if (all.empty()) return std::nullopt;
  auto repaired =
      geometry::repair(context, geometry::largest_components(all, geometry::connected_components(all), 1));
  if (!repaired) return std::nullopt;
  thin.mesh = std::move(repaired->mesh);
  return thin;
}

void SampledSkin::find_depths(const engine::Context& context, const MeshDistance& distance) {
  if (!depth_.value.empty()) return;
  depth_ = distances_.sample(context, [](double d, const Vec3&) { return d; });
  const std::size_t nx = depth_.nodes[0], ny = depth_.nodes[1], nz = depth_.nodes[2];
  engine::parallel_for(context, ny * nz, 1, [&](std::size_t row, std::size_t) {
    for (std::size_t x = 0; x < nx; ++x) {
      float& value = depth_.value[depth_.index(x, row % ny, row / ny)];
      const Vec3 node(static_cast<double>(x), static_cast<double>(row % ny), static_cast<double>(row / ny));
      const Vec3 at = depth_.low + depth_.cell_m * node;
      value = value < 0.0F ? static_cast<float>((distance.closest_point(at).point - at).norm()) : -1.0F;
    }
  });
}

void SampledSkin::wall_limbs(const engine::Context& context, const MeshDistance& distance, double neck) {
  find_depths(context, distance);
  wall_ = limb_walls(depth_, neck);
}

void SampledSkin::wall_known_limbs(const engine::Context& context, const MeshDistance& distance,
                                   const Anatomy& found, const std::vector<Fold>& folds) {
  find_depths(context, distance);
  wall_ = known_walls(depth_, found, folds);
}

Anatomy carry_out(const engine::Context& context, const ThinCopy& thin, const Anatomy& found,
                  const TriMesh& skin) {
  Anatomy out = found;
  const MeshDistance below(context, thin.mesh), surface(context, skin);
  out.part = spread(skin, parts_below(thin, below, found, skin));
  const auto mark = [&](LandmarkId id) -> body::Landmark& {
    return out.landmarks[static_cast<std::size_t>(id)];
  };
  const auto move_to_end = [&](const Tip& tip) {
    const Index end = end_of(skin, out.part, tip.part, mark(tip.joint).position,
                             found.landmarks[static_cast<std::size_t>(tip.tip)].position);
    if (end != kNoIndex) mark(tip.tip).position = skin.positions[end];
  };
  std::ranges::for_each(kTipsOfLimbs, move_to_end);
  // The end of a head may be hair that stands off it, before which the copy has its crown.
  if (std::ranges::any_of(found.warnings, is_of_crown))
    mark(LandmarkId::kCrown).position = surface.closest_point(mark(LandmarkId::kCrown).position).point;
  else
    move_to_end(kTopOfHead);
  for (const LandmarkId id : {LandmarkId::kArmpitL, LandmarkId::kArmpitR, LandmarkId::kPerineum})
    mark(id).position -= thin.depth * out.up;
  for (body::Landmark& landmark : out.landmarks) {
    if (lies_on_skin(landmark.id)) landmark.position = surface.closest_point(landmark.position).point;
    landmark.vertex = nearest_vertex(skin, landmark.position);
  }
  const auto middle = [&](LandmarkId left, LandmarkId right) {
    return Vec3(0.5 * (mark(left).position + mark(right).position));
  };
  const double by_copy_m = found.stature_m + 2.0 * thin.depth;  // The copy lacks its depth at sole and crown.
  out.stature_m = stature_of({mark(LandmarkId::kCrown).position,
                              mark(LandmarkId::kNeck).position,
                              mark(LandmarkId::kPerineum).position,
                              middle(LandmarkId::kKneeL, LandmarkId::kKneeR),
                              middle(LandmarkId::kAnkleL, LandmarkId::kAnkleR),
                              {mark(LandmarkId::kToeL).position, mark(LandmarkId::kToeR).position}},
                             skin.positions, upright_height(out).value_or(by_copy_m));
  return out;
}

}  // namespace bodice::anatomy
