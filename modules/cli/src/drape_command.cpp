#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>

#include <bodice/tryon/rigged_body.hpp>
#include <bodice/tryon/wearing.hpp>

#include "garment_kinds.hpp"
#include "run.hpp"
#include "validators.hpp"

namespace bodice::cli {
namespace {

struct DrapeCommand {
  CommonOptions common;
  std::vector<std::string> garments;
  std::string made = "skirt", output = "drape.glb", hold = "auto", fabric = "cotton";
  std::vector<double> wind_m_s;
  std::optional<double> thickness_mm;
  std::optional<int> frames;
  bool no_picture = false;
  std::string contact_sheet;
  int sheet_columns = 8;
  tryon::MotionChoice motion;
  tryon::DrapeOptions drape;

  bool moves() const { return !motion.motion.empty(); }
};

/// The skin of the run's body, and what moves it.
struct DrapedBody {
  tryon::SegmentedSkin skin;
  std::optional<tryon::BodyMotion> motion;
};

engine::Result<DrapedBody> read_body(Run& run, const DrapeCommand& command) {
  auto skin = command.moves() ? run.segment_rigged() : run.segment();
  if (!skin) return std::move(skin).error();
  if (!command.moves()) return DrapedBody{std::move(skin).value(), std::nullopt};
  auto motion = tryon::find_motion(run.context(), *skin, command.motion, skin->warnings);
  if (!motion) return std::move(motion).error();
  return DrapedBody{std::move(skin).value(), std::move(motion).value()};
}

engine::Result<std::vector<tryon::WornGarment>> wear_files(const Run& run, const DrapeCommand& command,
                                                           tryon::SegmentedSkin& skin) {
  std::vector<tryon::WornGarment> worn;
  for (const std::string& file : command.garments) {
    auto garment = io::import_garment(run.context(), file, skin.input.frame);
    if (!garment) return std::move(garment).error();
    skin.warnings.insert(skin.warnings.end(), garment->warnings.begin(), garment->warnings.end());
    worn.push_back({.name = file, .mesh = std::move(garment->skin)});
  }
  return worn;
}

engine::Result<std::vector<tryon::WornGarment>> make_garment(const Run& run, const DrapeCommand& command,
                                                             const tryon::SegmentedSkin& skin) {
  auto garment = make_garment_for(run.context(), skin, command.made);
  if (!garment) return std::move(garment).error();
  std::vector<geometry::Index> held;
  if (command.hold == "auto") held = std::move(garment->pinned);
  return std::vector<tryon::WornGarment>{
      {.name = command.made, .mesh = std::move(garment->mesh), .held = std::move(held)}};
}

engine::Result<std::vector<tryon::WornGarment>> dress(const Run& run, const DrapeCommand& command,
                                                      tryon::SegmentedSkin& skin) {
  if (command.garments.empty()) return make_garment(run, command, skin);
  auto worn = wear_files(run, command, skin);
  if (worn && command.hold == "auto")
    for (tryon::WornGarment& garment : *worn) garment.held = tryon::held_vertices(garment.mesh, skin);
  return worn;
}

engine::Result<void> write_outputs(Run& run, const DrapeCommand& command, const tryon::PreparedBody& body,
                                   const rig::Rig* rig, tryon::DrapeResult draped,
                                   std::vector<std::string>& written) {
  io::Scene scene = scene_of(body);
  scene.rig = rig;
  scene.proxy_frames = draped.proxy_frames;
  scene.garments = std::move(draped.garments);
  scene.body_frames = draped.body_frames;
  if (auto saved = io::write_glb(scene, command.output); !saved) return saved;
  written.push_back(command.output);
  if (const std::string& picture = command.common.picture; !picture.empty()) {
    const std::size_t kept = scene.garments.front().frames.size();
    const std::size_t frames[] = {0, (kept - 1) / 2, kept - 1};
    if (auto saved = io::write_picture(scene, frames, picture); !saved) return saved;
    written.push_back(picture);
  }
  if (!command.contact_sheet.empty()) {
    std::vector<std::size_t> frames(scene.garments.front().frames.size());
    std::iota(frames.begin(), frames.end(), std::size_t{0});
    if (auto saved = io::write_contact_sheet(scene, frames, command.sheet_columns, command.contact_sheet,
                                             {.width = 240, .height = 320});
        !saved)
      return saved;
    written.push_back(command.contact_sheet);
  }
  return run.write_page(body, scene, &draped.report, written);
}

/// The frames that play a clip once, when the user gives no number.
int frames_of(const rig::Clip& clip, double dt_s) {
  return dt_s > 0.0 ? std::max(1, static_cast<int>(std::ceil(clip.duration_s / dt_s - 1e-6))) : 1;
}

engine::Result<tryon::DrapeOptions> drape_options(const DrapeCommand& command, const geometry::Frame& frame,
                                                  const tryon::BodyMotion* motion) {
  tryon::DrapeOptions options = command.drape;
  options.motion = motion;
  if (motion) options.frames = frames_of(motion->clip, options.dt_s);
  if (command.frames) options.frames = *command.frames;
  auto fabric = cloth::find_fabric(command.fabric);
  if (!fabric) return std::move(fabric).error();
  options.fabric = std::move(fabric).value();
  options.solver.seed = command.common.seed;
  if (command.thickness_mm) options.thickness_m = *command.thickness_mm * 1e-3;
  if (!command.wind_m_s.empty())
    options.solver.environment.wind_m_s =
        frame.rotation() * geometry::Vec3(command.wind_m_s[0], command.wind_m_s[1], command.wind_m_s[2]);
  return options;
}

engine::Result<void> drape(const DrapeCommand& command) {
  const CommonOptions& o = command.common;
  Run run(o);
  std::vector<FileOption> garments;
  for (const std::string& file : command.garments) garments.push_back({"GARMENT", file});
  if (auto ok = run.check_files(
          {{"-o", command.output, {".glb"}}, {"--contact-sheet", command.contact_sheet, {".png"}}},
          std::move(garments));
      !ok)
    return ok;
  auto draped_body = read_body(run, command);
  if (!draped_body) return std::move(draped_body).error();
  auto& [skin, motion] = *draped_body;
  auto worn = dress(run, command, skin);
  if (!worn) return std::move(worn).error();
  const auto region = run.region_garments(skin);
  if (!region) return region.error();
  auto fit_options = run.fit_options_for(skin, *region);
  if (!fit_options) return std::move(fit_options).error();
  auto options = drape_options(command, skin.input.frame, motion ? &*motion : nullptr);
  if (!options) return std::move(options).error();

  const auto progress = run.progress().callback();
  auto body = motion ? tryon::fit_bound_proxy(run.context(), std::move(skin), *fit_options, progress)
                     : tryon::fit_proxy(run.context(), std::move(skin), *fit_options, progress);
  if (!body) return std::move(body).error();
  auto draped = tryon::drape(run.context(), *body, *worn, *options, run.progress().callback());
  if (!draped) return std::move(draped).error();
  std::vector<std::string> written;
  const tryon::DrapeReport report = draped->report;
  if (motion) motion->rig.clips = {motion->clip};
  if (auto done = write_outputs(run, command, *body, motion ? &motion->rig : nullptr,
                                std::move(draped).value(), written);
      !done)
    return done;
  return run.finish(*body, &report, written);
}

void add_motion_options(CLI::App& sub, DrapeCommand& c) {
  const auto group = "Motion";
  auto* motion =
      sub.add_option(
             "--motion", c.motion.motion,
             "move the body: walk, run, turn, spin, reach, sit, squat, arms-up, dance, or a file with a "
             "skeleton and clips (GLB, FBX, DAE, BVH)")
          ->check(not_empty())
          ->group(group);
  sub.add_option("--clip", c.motion.clip, "name of the file's clip (default: its first)")
      ->check(not_empty())
      ->needs(motion)
      ->group(group);
  sub.add_flag("--loop", c.drape.loop, "start the clip over at its end")->needs(motion)->group(group);
  sub.add_option(
         "--ramp", c.drape.ramp_s,
         "seconds from the pose of the file to the clip's first frame (default: by how far the skin moves)")
      ->check(between(0.0, 60.0))
      ->needs(motion)
      ->group(group);
  sub.add_option("--frames", c.frames, "frames to simulate (default: 120, or the clip once)")
      ->check(whole(1, 100000))
      ->group(group);
  sub.add_option("--dt", c.drape.dt_s, "seconds a frame")
      ->check(between(0.0, 1.0))
      ->group(group)
      ->capture_default_str();
  sub.add_option("--substeps", c.drape.solver.substeps, "solver steps a frame: more is stiffer and slower")
      ->check(whole(1, cloth::kMaxSubsteps))
      ->group(group)
      ->capture_default_str();
  auto* wind = sub.add_option("--wind", c.wind_m_s, "x,y,z in the file's axes, meters a second");
  wind->delimiter(',')->check(finite())->expected(3)->group(group);
  sub.add_option("--gust", c.drape.solver.environment.gust, "share of the wind that fluctuates")
      ->check(between(0.0, 1.0))
      ->needs(wind)
      ->group(group)
      ->capture_default_str();
  sub.add_option("--fabric", c.fabric, "cotton, silk, denim, jersey, leather")
      ->check(CLI::IsMember(cloth::fabric_names()))
      ->group(group)
      ->capture_default_str();
  sub.add_option("--thickness-mm", c.thickness_mm,
                 "distance that particles keep from the skin (default: so that triangles stay out too)")
      ->check(between(0.0, 100.0))
      ->group(group);
  sub.add_option("--keep", c.drape.kept_frames, "frames kept in the GLB")
      ->check(whole(2, 10000))
      ->group(group)
      ->capture_default_str();
}

}  // namespace

void add_drape_command(CLI::App& app, int& exit_code, const std::vector<std::string>& command_line) {
  auto command = std::make_shared<DrapeCommand>();
  command->common.command_line = command_line;
  CLI::App* sub = app.add_subcommand("drape", "Drape garments over a body under gravity and wind");
  add_common_options(*sub, command->common);
  auto* garments =
      sub->add_option("GARMENT", command->garments,
                      "garment meshes in the body's coordinates and unit (default: one made to fit)");
  garments->check(not_empty());
  sub->add_option("--garment", command->made, "without GARMENT, make this: skirt, tunic, poncho, tube")
      ->check(CLI::IsMember({"skirt", "tunic", "poncho", "tube"}))
      ->excludes(garments)
      ->group("Garment")
      ->capture_default_str();
  sub->add_option("--hold", command->hold, "auto: waistbands stay with the body; none: everything is free")
      ->check(CLI::IsMember({"auto", "none"}))
      ->group("Garment")
      ->capture_default_str();
  add_motion_options(*sub, *command);
  sub->add_option("-o,--output", command->output,
                  "body, ellipsoids and moving cloth, .glb for any glTF viewer")
      ->check(not_empty())
      ->group("Output")
      ->capture_default_str();
  sub->add_option("--contact-sheet", command->contact_sheet, "write a PNG with a view of every kept frame")
      ->check(not_empty())
      ->group("Output");
  sub->add_flag("--no-picture", command->no_picture, "write no PNG beside the output")
      ->excludes("--picture")
      ->group("Output");
  sub->footer("Example: bodice drape body.obj dress.obj -o out.glb --frames 120 --wind 0,0,2");
  sub->callback([command, &exit_code] {
    if (!command->no_picture && command->common.picture.empty())
      command->common.picture = std::filesystem::path(command->output).replace_extension(".png").string();
    const auto done = drape(*command);
    exit_code = done ? kExitOk : fail(done.error());
  });
}

}  // namespace bodice::cli
