#include <bodice/tryon/prepare.hpp>

#include <utility>

#include "append.hpp"
#include "load_body.hpp"
#include "segment_tasks.hpp"

namespace bodice::tryon {
namespace {

using geometry::MeshDistance;

void report(const Progress& progress, std::string_view stage, double fraction) {
  if (progress) progress(stage, fraction);
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
  return segment_source(context, BodyFile{file}, options, progress);
}

engine::Result<SegmentedSkin> segment_builtin(const engine::Context& context, const synth::BodyOptions& body,
                                              const SegmentOptions& options, const Progress& progress) {
  return segment_source(context, body, options, progress);
}

engine::Result<SegmentedSkin> segment_mesh(const engine::Context& context, io::ImportedMesh input,
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
  if (!fit) return of_body(std::move(fit).error(), skin.input);
  return PreparedBody{.skin = std::move(skin), .fit = std::move(fit).value()};
}

}  // namespace bodice::tryon
