#include "load_body.hpp"

#include <utility>

#include <bodice/engine/stage_timer.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::tryon {
namespace {

engine::Result<io::ImportedMesh> make_builtin(const engine::Context& context,
                                              const synth::BodyOptions& options) {
  io::ImportedMesh input;
  engine::StageTimer load(context, input.stages, "load");
  auto made = synth::make_body(context, options);
  load.stop();
  if (!made) return std::move(made).error();
  engine::StageTimer check(context, input.stages, "check");
  auto repaired = geometry::repair(context, made->mesh);
  check.stop();
  if (!repaired) return std::move(repaired).error();

  input.file = "built-in";
  input.mesh = options.sex == body::Sex::kFemale ? "female" : "male";
  input.unit = "m";
  input.skin = std::move(repaired->mesh);
  input.vertex_of_input = std::move(repaired->vertex_of_input);
  input.repair = std::move(repaired->report);
  input.input_vertices = made->mesh.positions.size();
  input.input_triangles = made->mesh.triangles.size();
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

engine::Result<io::ImportedMesh> load_body(const engine::Context& context, const BodySource& source,
                                           const io::ImportOptions& options) {
  return std::visit(Loader{context, options}, source);
}

engine::Error of_body(engine::Error error, const io::ImportedMesh& body) {
  error.message = (body.file.empty() ? "The given body" : body.file.string()) + ": " + error.message;
  return error;
}

}  // namespace bodice::tryon
