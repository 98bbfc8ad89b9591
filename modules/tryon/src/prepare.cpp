#include <bodice/tryon/prepare.hpp>

#include <atomic>
#include <utility>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::tryon {
namespace {

using geometry::MeshDistance;

void tell(const Progress& progress, std::string_view stage, double fraction) {
  if (progress) progress(stage, fraction);
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

engine::Result<body::ProportionProfile> profile_or_default(const SegmentOptions& options) {
  if (!options.profile.name.empty()) return options.profile;
  return body::find_profile("ansur2");
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
  tell(progress, "load", 0.0);
  auto input = io::import_body(context, file, options.import);
  if (!input) return std::move(input).error();
  return segment_mesh(context, std::move(input).value(), options, progress);
}

engine::Result<SegmentedSkin> segment_builtin(const engine::Context& context, const synth::BodyOptions& body,
                                              const SegmentOptions& options, const Progress& progress) {
  tell(progress, "make body", 0.0);
  io::ImportedMesh input;
  engine::StageTimer load(context, input.stages, "load");
  auto made = synth::make_body(context, body);
  load.stop();
  if (!made) return std::move(made).error();
  engine::StageTimer check(context, input.stages, "check");
  auto repaired = geometry::repair(context, made->mesh);
  check.stop();
  if (!repaired) return std::move(repaired).error();

  input.file = "built-in";
  input.mesh = body.sex == body::Sex::kFemale ? "female" : "male";
  input.unit = "m";
  input.skin = std::move(repaired->mesh);
  input.vertex_of_input = std::move(repaired->vertex_of_input);
  input.repair = std::move(repaired->report);
  input.input_vertices = made->mesh.positions.size();
  input.input_triangles = made->mesh.triangles.size();
  return segment_mesh(context, std::move(input), options, progress);
}

engine::Result<SegmentedSkin> segment_mesh(const engine::Context& context, io::ImportedMesh input,
                                           const SegmentOptions& options, const Progress& progress) {
  auto profile = profile_or_default(options);
  if (!profile) return std::move(profile).error();
  tell(progress, "segment", 0.0);
  auto found = anatomy::analyse(context, input.skin, {.profile = std::move(profile).value()});
  if (!found) {
    engine::Error error = std::move(found).error();
    error.message = input.file.string() + ": " + error.message;
    return error;
  }

  SegmentedSkin skin;
  skin.input = std::move(input);
  skin.anatomy = std::move(found).value();
  skin.stages = skin.input.stages;
  append(skin.stages, skin.anatomy.stages);
  {
    engine::StageTimer timer(context, skin.stages, "distance");
    skin.distance = std::make_shared<const MeshDistance>(context, skin.input.skin);
  }
  skin.warnings = skin.input.warnings;
  append(skin.warnings, skin.anatomy.warnings);
  return skin;
}

engine::Result<PreparedBody> fit_proxy(const engine::Context& context, SegmentedSkin skin,
                                       const fitting::FitOptions& options, const Progress& progress) {
  tell(progress, "fit", 0.0);
  const fitting::LabelledSkin labelled{.mesh = skin.input.skin,
                                       .part = skin.anatomy.part,
                                       .stature_m = skin.anatomy.stature_m,
                                       .frame = skin.input.frame,
                                       .distance = skin.distance.get()};
  auto fit = fitting::fit(context, labelled, options);
  if (!fit) {
    engine::Error error = std::move(fit).error();
    error.message = skin.input.file.string() + ": " + error.message;
    return error;
  }
  return PreparedBody{.skin = std::move(skin), .fit = std::move(fit).value()};
}

std::uint32_t reachable_parts(const engine::Context& context, const SegmentedSkin& skin,
                              std::span<const geometry::TriMesh> garments, double margin_m) {
  const geometry::TriMesh& mesh = skin.input.skin;
  std::atomic<std::uint32_t> reached = 0;  // a union of bits: the order of the writers does not matter
  for (const geometry::TriMesh& garment : garments) {
    const MeshDistance to_garment(context, garment);
    engine::parallel_for(context, mesh.positions.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const std::uint32_t bit = 1u << static_cast<int>(skin.anatomy.part[v]);
        if (reached.load(std::memory_order_relaxed) & bit) continue;
        if (to_garment.nearest_within(mesh.positions[v], margin_m)) reached.fetch_or(bit);
      }
    });
  }
  return reached;
}

}  // namespace bodice::tryon
