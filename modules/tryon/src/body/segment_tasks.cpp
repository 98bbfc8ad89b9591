#include "body/segment_tasks.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <bodice/anatomy/thing.hpp>
#include <bodice/engine/stage_timer.hpp>

#include "body/append.hpp"
#include "body/load_body.hpp"
#include "body/scan_doubts.hpp"
#include "body/stand_upright.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::MeshDistance;

struct DistanceField {
  std::shared_ptr<const MeshDistance> distance;
  std::vector<engine::StageTime> stages;
};

/// Keeps one of the two warnings of holes: repair and anatomy both count a body's open edges.
void drop_repeated_holes(std::vector<engine::Warning>& warnings) {
  const auto has_code = [](std::string_view code) {
    return [code](const engine::Warning& warning) { return warning.code == code; };
  };
  if (std::ranges::any_of(warnings, has_code("holes"))) std::erase_if(warnings, has_code("open-edges"));
}

DistanceField measure_distances(const engine::Context& context, const io::ImportedMesh& mesh) {
  DistanceField field;
  const engine::StageTimer timer(context, field.stages, "distance");
  field.distance = std::make_shared<const MeshDistance>(context, mesh.skin);
  return field;
}

std::shared_ptr<SegmentedSkin> join_skin(const engine::Context& context, const io::ImportedMesh& mesh,
                                         const anatomy::Anatomy& anatomy, const DistanceField& field) {
  auto skin = std::make_shared<SegmentedSkin>(SegmentedSkin{.input = mesh,
                                                            .anatomy = anatomy,
                                                            .distance = field.distance,
                                                            .stages = mesh.stages,
                                                            .warnings = mesh.warnings});
  append(skin->stages, anatomy.stages);
  append(skin->stages, field.stages);
  append(skin->warnings, anatomy.warnings);
  warn_of_scan(mesh, anatomy, skin->warnings);
  drop_repeated_holes(skin->warnings);
  if (stand_upright(skin->input, skin->anatomy))
    skin->distance = std::make_shared<const MeshDistance>(context, skin->input.skin);
  return skin;
}

}  // namespace

engine::Result<engine::Output<std::shared_ptr<SegmentedSkin>>> add_segment_tasks(
    engine::GraphBuilder& builder, const engine::Output<io::ImportedMesh>& mesh,
    const SegmentOptions& options) {
  const auto profile = options.profile ? engine::Result<body::ProportionProfile>(*options.profile)
                                       : body::find_profile("ansur2");
  if (!profile) return profile.error();
  auto anatomy = builder.add(
      "anatomy",
      [known = anatomy::Options{.profile = *profile, .force = options.force}](
          const engine::Context& context, const io::ImportedMesh& body) -> engine::Result<anatomy::Anatomy> {
        anatomy::Options of_this = known;
        of_this.made_up = body.made_up;
        auto found = body.shape == io::Shape::kAny ? anatomy::analyze_thing(context, body.skin)
                                                   : anatomy::analyze(context, body.skin, of_this);
        if (!found) return with_body_name(std::move(found).error(), body);
        return found;
      },
      mesh);
  auto field = builder.add("distance field", measure_distances, mesh);
  builder.set_priority(anatomy, 1);  // the longer one starts first
  return builder.add("skin", join_skin, mesh, anatomy, field);
}

}  // namespace bodice::tryon
