#include "body/load_body.hpp"

#include <utility>

#include <bodice/engine/stage_timer.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/io/rig.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

engine::Result<io::ImportedMesh> make_builtin(const engine::Context& context,
                                              const synth::BodyOptions& options) {
  std::vector<engine::StageTime> stages;
  engine::StageTimer load(context, stages, "load");
  auto made = synth::make_body(context, options);
  load.stop();
  if (!made) return std::move(made).error();
  auto input = repair_body(context, made->mesh);
  if (!input) return std::move(input).error();
  input->file = "built-in";
  input->mesh = options.sex == body::Sex::kFemale ? "female" : "male";
  input->stages.insert(input->stages.begin(), stages.begin(), stages.end());
  return input;
}

struct Loader {
  const engine::Context& context;
  const io::ImportOptions& options;

  engine::Result<io::ImportedMesh> operator()(const BodyFile& body) const {
    return io::import_body(context, body.file, options);
  }
  engine::Result<io::ImportedMesh> operator()(const synth::BodyOptions& body) const {
    return make_builtin(context, body);
  }
  engine::Result<io::ImportedMesh> operator()(const io::ImportedMesh& body) const { return body; }
};

}  // namespace

engine::Result<io::ImportedMesh> repair_body(const engine::Context& context, const geometry::TriMesh& mesh) {
  io::ImportedMesh input;
  engine::StageTimer check(context, input.stages, "check");
  auto repaired = geometry::repair(context, mesh);
  check.stop();
  if (!repaired) return std::move(repaired).error();
  input.unit = "m";
  input.skin = std::move(repaired->mesh);
  input.vertex_of_input = std::move(repaired->vertex_of_input);
  input.repair = std::move(repaired->report);
  input.input_vertices = mesh.positions.size();
  input.input_triangles = mesh.triangles.size();
  return input;
}

engine::Result<io::ImportedMesh> load_body(const engine::Context& context, const BodySource& source,
                                           const io::ImportOptions& options) {
  return std::visit(Loader{context, options}, source);
}

engine::Result<LoadedBody> load_rigged_body(const engine::Context& context, const BodySource& source,
                                            const io::ImportOptions& options) {
  const auto* const file = std::get_if<BodyFile>(&source);
  if (!file) {
    auto body = load_body(context, source, options);
    if (!body) return std::move(body).error();
    return LoadedBody{std::move(body).value(), nullptr};
  }
  auto read = io::import_rigged_body(context, file->file, options);
  if (!read) return std::move(read).error();
  LoadedBody loaded{std::move(read->body), nullptr};
  if (read->rig)
    loaded.rig = std::make_shared<const rig::Rig>(std::move(read->rig).value());
  else if (read->rig.error().code != engine::ErrorCode::kNotFound)
    loaded.body.warnings.push_back(
        {"rig-not-usable", "", read->rig.error().message, read->rig.error().remedy});
  return loaded;
}

engine::Error with_body_name(engine::Error error, const io::ImportedMesh& body) {
  error.message = (body.file.empty() ? "The given body" : body.file.string()) + ": " + error.message;
  return error;
}

}  // namespace bodice::tryon
