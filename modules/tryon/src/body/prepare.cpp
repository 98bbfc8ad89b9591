#include <bodice/tryon/prepare.hpp>

#include <utility>

#include <bodice/binding/bind.hpp>
#include <bodice/binding/flexed_skin.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/io/rig.hpp>

#include "body/append.hpp"
#include "body/load_body.hpp"
#include "body/refine_thing.hpp"
#include "body/segment_tasks.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::MeshDistance;

void report(const Progress& progress, std::string_view stage, double fraction) {
  if (progress) progress(stage, fraction);
}

engine::Result<SegmentedSkin> segment_unrefined(const engine::Context& context, io::ImportedMesh input,
                                                const SegmentOptions& options, const Progress& progress) {
  report(progress, "segment", 0.0);
  engine::GraphBuilder builder;
  auto mesh = builder.input<io::ImportedMesh>("body");
  auto skin = add_segment_tasks(builder, mesh, options);
  if (!skin) return std::move(skin).error();
  auto graph = std::move(builder).build();
  if (!graph) return std::move(graph).error();
  graph->set(mesh, std::move(input));
  if (auto run = graph->run(context); !run) return std::move(run).error();
  return std::move(*graph->take(*skin));
}

engine::Result<SegmentedSkin> segment_source(const engine::Context& context, const BodySource& source,
                                             const SegmentOptions& options, const Progress& progress) {
  report(progress, "load", 0.0);
  auto input = load_body(context, source, options.import);
  if (!input) return std::move(input).error();
  return segment_mesh(context, std::move(input).value(), options, progress);
}

}  // namespace

std::vector<engine::Warning> PreparedBody::all_warnings() const {
  std::vector<engine::Warning> all = skin.warnings;
  append(all, fit.warnings);
  return all;
}

std::vector<engine::StageTime> PreparedBody::all_stages() const {
  std::vector<engine::StageTime> all = skin.stages;
  append(all, fit.stages);
  return all;
}

engine::Result<SegmentedSkin> segment_file(const engine::Context& context, const std::filesystem::path& file,
                                           const SegmentOptions& options, const Progress& progress) {
  report(progress, "load", 0.0);
  auto input = io::import_rigged_body(context, file, options.import);
  if (!input) return std::move(input).error();
  // A skin with a rig is not refined, because the rig has weights for the file's vertices alone.
  auto skin =
      (input->rig ? segment_unrefined : segment_mesh)(context, std::move(input->body), options, progress);
  if (skin && input->rig) skin->rig = std::make_shared<const rig::Rig>(std::move(input->rig).value());
  if (skin && !input->rig && input->rig.error().code != engine::ErrorCode::kNotFound)
    skin->warnings.push_back({"rig-not-usable", "", input->rig.error().message, input->rig.error().remedy});
  return skin;
}

engine::Result<SegmentedSkin> segment_builtin(const engine::Context& context, const synth::BodyOptions& body,
                                              const SegmentOptions& options, const Progress& progress) {
  return segment_source(context, body, options, progress);
}

engine::Result<SegmentedSkin> segment_mesh(const engine::Context& context, io::ImportedMesh input,
                                           const SegmentOptions& options, const Progress& progress) {
  if (input.shape == io::Shape::kAny) refine_thing(input);
  return segment_unrefined(context, std::move(input), options, progress);
}

fitting::LabeledSkin labeled(const SegmentedSkin& skin) {
  return {.mesh = skin.input.skin,
          .part = skin.anatomy.part,
          .stature_m = skin.anatomy.stature_m,
          .frame = skin.input.frame,
          .distance = skin.distance.get()};
}

engine::Result<PreparedBody> fit_proxy(const engine::Context& context, SegmentedSkin skin,
                                       const fitting::FitOptions& options, const Progress& progress) {
  report(progress, "fit", 0.0);
  auto fit = fitting::fit(context, labeled(skin), options);
  if (!fit) return with_body_name(std::move(fit).error(), skin.input);
  return PreparedBody{.skin = std::move(skin), .fit = std::move(fit).value()};
}

engine::Result<PreparedBody> fit_bound_proxy(const engine::Context& context, SegmentedSkin skin,
                                             fitting::FitOptions options, const Progress& progress) {
  if (!skin.rig) return fit_proxy(context, std::move(skin), options, progress);
  const std::shared_ptr<const rig::Rig> rig = skin.rig;
  std::vector<geometry::Vec3> flexed =
      binding::flexed_skin(context, {skin.input.skin, rig->skeleton, rig->weights}, skin.anatomy.part);
  options.flexed = flexed;
  auto body = fit_proxy(context, std::move(skin), options, progress);
  if (!body) return body;
  report(progress, "bind", 0.0);
  engine::StageTimer timer(context, body->fit.stages, "bind");
  auto bound = binding::bind(context, body->fit.proxy,
                             {body->skin.input.skin, rig->skeleton, rig->weights, body->skin.anatomy.part});
  timer.stop();
  if (!bound) return with_body_name(std::move(bound).error(), body->skin.input);
  body->fit.proxy = std::move(bound).value();
  return body;
}

}  // namespace bodice::tryon
