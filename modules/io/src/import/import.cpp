#include <algorithm>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/geometry/folds.hpp>
#include <bodice/geometry/noise.hpp>
#include <bodice/io/import.hpp>
#include <bodice/io/rig.hpp>

#include "import/body/body_frame.hpp"
#include "import/body/choose_body.hpp"
#include "import/body/close_skin.hpp"
#include "import/body/thin_skin.hpp"
#include "import/rig/build_rig.hpp"
#include "import/scene/file_scene.hpp"
#include "import/scene/joined_look.hpp"

namespace bodice::inline v0_1::io {

namespace {

/// Single precision keeps 24 bits. If it spaces positions more widely than the threshold, there is a warning.
constexpr double kFloatGrid = 0x1p-23;
constexpr double kCoarseGrid_m = 1e-4;

/// The error of any stage, preceded by the file's name if the sentence lacks it.
engine::Error in_file(engine::Error error, const std::filesystem::path& file) {
  const std::string name = file.string();
  if (error.message.find(name) == std::string::npos) error.message = "'" + name + "': " + error.message;
  return error;
}

void append_warnings(std::vector<engine::Warning> from, std::vector<engine::Warning>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

/// Warns if the file lies so far from its origin that single precision matters.
void check_precision(const geometry::TriMesh& shape, bool kept_digits, ImportedMesh& out) {
  double farthest = 0.0;
  for (const geometry::Vec3& p : shape.positions)
    if (p.allFinite()) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  const double grid_m = farthest * kFloatGrid * out.frame.meters_per_unit;
  if (kept_digits || grid_m <= kCoarseGrid_m) return;
  out.warnings.push_back({"far-from-origin", out.mesh,
                          engine::message("The mesh lies so far from the origin that its coordinates are ",
                                          1e3 * grid_m, " mm apart in the reader's single precision."),
                          "Move it near the origin before exporting, or export it as OBJ."});
}

/// Skins with folds at more than this share of the vertices are evened out; clean ones have .01.
constexpr double kFolded = 0.03;

/// Smooths noise and thins what is too fine, as the options want it, and evens out folded triangles. Returns
/// the noise, in the mesh's unit.
engine::Result<double> refine_scan(const engine::Context& context, const ImportOptions& options,
                                   geometry::RepairedMesh& scan, std::vector<engine::Warning>& warnings) {
  return engine::catch_canceled("The smoothing of noise", [&]() -> engine::Result<double> {
    const geometry::RoughSurface surface(scan.mesh);
    const double noise = geometry::noise_of(context, surface);
    const bool noisy = noise > 0.0, keeps = noisy && options.keep_noise;
    if (is_overfine(scan.mesh) && !options.keep_vertices && !keeps)
      warnings.push_back(thin_skin(context, surface, noise, scan));
    else if (noisy && !keeps)
      scan.mesh.positions = geometry::without_noise(context, surface, noise);
    if (!keeps && geometry::folded_share(scan.mesh) > kFolded)
      scan.mesh.positions = geometry::without_folds(context, scan.mesh);
    return noise;
  });
}

void warn_of_noise(ImportedMesh& out) {
  if (!(out.noise_m > 0.0)) return;
  const std::string size = engine::message("The skin has noise of ", 1e3 * out.noise_m, " mm");
  if (out.smoothed)
    out.warnings.push_back(engine::note("noise-smoothed", out.mesh,
                                        size + ", which was smoothed; accuracy counts from the smooth skin.",
                                        "To fit the noise as well, keep it (program: --keep-noise)."));
  else
    out.warnings.push_back(engine::note("noise-kept", out.mesh, size + ", which was kept.", ""));
}

void to_inside(const geometry::Frame& frame, geometry::TriMesh& mesh) {
  for (geometry::Vec3& p : mesh.positions) p = frame.to_inside(p);
}

/// A body with what is needed to find its rig.
struct ReadBody {
  ImportedMesh mesh;
  FileRig rig;
  FileWeights weights;  // of the input vertices
};

/// A skin in the file's coordinates, and the noise that its scan had, in the file's unit.
struct FoundSkin {
  geometry::RepairedMesh repaired;
  double noise = 0.0;
};

/// Repairs what was chosen and refines and closes it. A skin with weights stays as repaired: they are those
/// of its vertices.
engine::Result<FoundSkin> find_skin(const engine::Context& context, const ImportOptions& options,
                                    ChosenBody& chosen, bool has_weights, ImportedMesh& out) {
  auto repaired = chosen.repaired ? engine::Result<geometry::RepairedMesh>(std::move(*chosen.repaired))
                                  : geometry::repair(context, chosen.shape);
  if (!repaired) return repaired.error();
  FoundSkin skin{std::move(*repaired)};
  if (has_weights) return skin;
  if (options.shape != Shape::kAny) {
    const auto noise = refine_scan(context, options, skin.repaired, out.warnings);
    if (!noise) return noise.error();
    skin.noise = *noise;
  }
  out.smoothed = skin.noise > 0.0 && !options.keep_noise;
  if (auto closed = close_skin(context, chosen.shape, skin.repaired)) {
    skin.repaired = std::move(closed->repaired);
    out.made_up = std::move(closed->made_up);
  }
  return skin;
}

/// Finds unit and axes of the file by its skin.
void find_frame(const ImportOptions& options, const FileScene& scene, const geometry::TriMesh& skin,
                ImportedMesh& out) {
  const auto find = options.shape == Shape::kAny ? frame_of_thing : detect_frame;
  DetectedFrame detected = find(skin, options, scene.meters_per_unit, scene.up);
  out.frame = detected.frame;
  out.unit = std::move(detected.unit);
  out.up_found_by_extents = detected.up_found_by_extents;
  append_warnings(std::move(detected.warnings), out.warnings);
}

engine::Result<ReadBody> read_body_now(const engine::Context& context, const std::filesystem::path& file,
                                       const ImportOptions& options) {
  ReadBody read;
  ImportedMesh& out = read.mesh;
  out.file = file;
  engine::StageTimer load(context, out.stages, "load");
  auto scene = read_scene(file);
  if (!scene) return scene.error();
  load.stop();

  engine::StageTimer check(context, out.stages, "check");
  auto chosen = options.shape == Shape::kAny ? choose_all(*scene, options.mesh)
                                             : choose_body(context, *scene, options.mesh, options.person);
  if (!chosen) return in_file(chosen.error(), file);
  out.shape = options.shape;
  out.mesh = chosen->name;
  out.warnings = std::move(chosen->warnings);
  out.input_vertices = chosen->shape.positions.size();
  out.input_triangles = chosen->shape.triangles.size();

  auto skin = find_skin(context, options, *chosen, scene->rig.has_bones, out);
  if (!skin) return in_file(skin.error(), file);
  find_frame(options, *scene, skin->repaired.mesh, out);
  check_precision(chosen->shape, scene->kept_digits, out);
  out.noise_m = skin->noise * out.frame.meters_per_unit;
  warn_of_noise(out);

  out.skin = std::move(skin->repaired.mesh);
  to_inside(out.frame, out.skin);
  out.vertex_of_input = std::move(skin->repaired.vertex_of_input);
  out.repair = std::move(skin->repaired.report);
  append_warnings(out.repair.warnings, out.warnings);
  check.stop();
  read.rig = std::move(scene->rig);
  read.weights = std::move(chosen->weights);
  return read;
}

engine::Result<ReadBody> read_body(const engine::Context& context, const std::filesystem::path& file,
                                   const ImportOptions& options) {
  return engine::catch_canceled("The import", [&] { return read_body_now(context, file, options); });
}

}  // namespace

engine::Result<ImportedMesh> import_body(const engine::Context& context, const std::filesystem::path& file,
                                         const ImportOptions& options) {
  auto read = read_body(context, file, options);
  if (!read) return read.error();
  return std::move(read->mesh);
}

engine::Result<RiggedBody> import_rigged_body(const engine::Context& context,
                                              const std::filesystem::path& file,
                                              const ImportOptions& options) {
  auto read = read_body(context, file, options);
  if (!read) return read.error();
  RiggedBody out;
  out.body = std::move(read->mesh);
  engine::StageTimer stage(context, out.body.stages, "rig");
  auto rig = build_rig(read->rig, read->weights, out.body.skin, out.body.vertex_of_input, out.body.frame,
                       out.body.warnings);
  stage.stop();
  if (rig)
    out.rig = std::move(rig);
  else
    out.rig = in_file(rig.error(), file);
  return out;
}

engine::Result<ImportedMesh> import_garment(const engine::Context& context, const std::filesystem::path& file,
                                            const geometry::Frame& body_frame) {
  ImportedMesh out;
  out.file = file;
  engine::StageTimer load(context, out.stages, "load");
  auto scene = read_scene(file, LookOf::kGarment);
  if (!scene) return scene.error();
  load.stop();

  engine::StageTimer check(context, out.stages, "check");
  geometry::TriMesh all;
  for (const FileMesh& mesh : scene->meshes) append(mesh.shape, all);
  out.mesh = scene->meshes.size() == 1 ? scene->meshes.front().name
                                       : std::to_string(scene->meshes.size()) + " meshes";
  out.input_vertices = all.positions.size();
  out.input_triangles = all.triangles.size();
  auto repaired = geometry::repair(context, all, {.weld_relative = 0.0, .orient = false, .drop_fins = false});
  if (!repaired) return in_file(repaired.error(), file);
  out.frame = body_frame;
  out.unit = unit_name(body_frame.meters_per_unit);
  check_precision(all, scene->kept_digits, out);
  out.skin = std::move(repaired->mesh);
  to_inside(out.frame, out.skin);
  out.vertex_of_input = std::move(repaired->vertex_of_input);
  out.repair = std::move(repaired->report);
  std::erase_if(out.repair.warnings, [](const engine::Warning& w) { return w.code == "open-edges"; });
  append_warnings(out.repair.warnings, out.warnings);
  append_warnings(scene->look.warnings, out.warnings);
  out.look = joined_look(std::move(scene->look), scene->meshes, repaired->triangle_of_input);
  check.stop();
  return out;
}

}  // namespace bodice::io
