#include <bodice/tryon/segmentation.hpp>

#include <algorithm>
#include <array>

#include <bodice/engine/json.hpp>
#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

/// The depth from which a vertex counts as internal. Repair moves vertices of the skin by less.
constexpr double kInside_m = 1e-3;
constexpr std::array<const char*, 6> kRegions = {"body",     "left_arm",  "right_arm",
                                                 "left_leg", "right_leg", "face_internal"};
constexpr std::size_t kInternal = 5;

std::size_t region_of(body::Part part) {
  using enum body::Part;
  switch (part) {
    case kUpperArmL:
    case kForearmL:
      return 1;
    case kUpperArmR:
    case kForearmR:
      return 2;
    case kThighL:
    case kCalfL:
      return 3;
    case kThighR:
    case kCalfR:
      return 4;
    default:
      return 0;
  }
}

/// The part of the corner of a triangle that is nearest to a point.
body::Part part_near(const SegmentedSkin& skin, const geometry::SurfacePoint& at) {
  const geometry::TriMesh& mesh = skin.input.skin;
  const geometry::Triangle& corners = mesh.triangles[at.triangle];
  const auto nearest = std::ranges::min_element(
      corners, {}, [&](geometry::Index v) { return (mesh.positions[v] - at.point).squaredNorm(); });
  return skin.anatomy.part[*nearest];
}

}  // namespace

std::string segmentation_json(const engine::Context& context, const SegmentedSkin& skin,
                              std::span<const geometry::Vec3> vertices) {
  std::vector<std::size_t> region(vertices.size());
  engine::parallel_for(context, vertices.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto at = skin.distance->closest_point(skin.input.frame.to_inside(vertices[v]));
      region[v] = at.signed_distance < -kInside_m ? kInternal : region_of(part_near(skin, at));
    }
  });
  engine::Json lists;
  for (const char* name : kRegions) lists[name] = engine::Json::array();
  for (std::size_t v = 0; v < region.size(); ++v) lists[kRegions[region[v]]].push_back(v);
  return lists.dump() + "\n";
}

}  // namespace bodice::tryon
