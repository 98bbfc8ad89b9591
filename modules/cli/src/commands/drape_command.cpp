#include <algorithm>
#include <filesystem>
#include <memory>

#include "options/validators.hpp"
#include "run/drape_steps.hpp"

namespace bodice::inline v0_1::cli {
namespace {

engine::Result<void> drape(const DrapeCommand& command) {
  const CommonOptions& o = command.common;
  Run run(o);
  std::vector<FileOption> garments;
  for (const std::string& file : command.garments) garments.push_back({"GARMENT", file});
  for (const std::string& file : command.props) garments.push_back({"--prop", file});
  std::vector<FileOption> outputs = {{"-o", command.output, {".glb"}},
                                     {"--contact-sheet", command.contact_sheet, {".png"}},
                                     {"--film-strip", command.film_strip, {".png"}}};
  const std::size_t worn_count = std::max<std::size_t>(1, command.garments.size());
  for (std::size_t k = 0; !command.cache.empty() && k < worn_count; ++k)
    outputs.push_back({"--cache", cache_file(command, k), {".pc2", ".mdd"}});
  if (auto ok = run.check_files(std::move(outputs), std::move(garments)); !ok) return ok;
  auto skin = read_body(run, command);
  if (!skin) return std::move(skin).error();
  auto motion = find_motion(run, command, *skin);
  if (!motion) return std::move(motion).error();
  auto worn = dress(run, command, *skin);
  if (!worn) return std::move(worn).error();
  auto body = fit_body(run, std::move(skin).value(), command.moves());
  if (!body) return std::move(body).error();
  auto props = read_props(run, command, *body);
  if (!props) return std::move(props).error();
  DressedBody dressed{std::move(body).value(), std::move(motion).value(), std::move(worn).value(),
                      std::move(props).value()};
  std::vector<std::string> written;
  const auto report = drape_and_write(run, command, dressed, written);
  if (!report) return report.error();
  return run.finish(dressed.body, &*report, written);
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
  sub.add_flag("--loop", c.drape.loop,
               "start the clip over at its end, led back there where it does not end as it starts")
      ->needs(motion)
      ->group(group);
  sub.add_option(
         "--ramp", c.drape.ramp_s,
         "seconds from the pose of the file to the clip's first frame (default: by how far the skin moves)")
      ->check(between(0.0, 60.0))
      ->needs(motion)
      ->group(group);
  sub.add_flag("--no-prepare", c.no_prepare,
               "do not fit the proxy to poses along the clip beforehand: it begins seconds earlier, and more "
               "skin shows")
      ->needs(motion)
      ->group(group);
}

void add_simulation_options(CLI::App& sub, DrapeCommand& c) {
  const auto group = "Simulation";
  sub.add_option("--frames", c.frames, "frames to simulate (default: 120, or the clip once)")
      ->check(whole(1, kMostFrames))
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

void add_garment_options(CLI::App& sub, DrapeCommand& c) {
  const auto group = "Garment";
  auto* garments = sub.add_option(
      "GARMENT", c.garments, "garment meshes in the body's coordinates and unit (default: one made to fit)");
  garments->check(not_empty());
  sub.add_option("--garment", c.made, "without GARMENT, make this: skirt, tunic, poncho, tube")
      ->check(CLI::IsMember({"skirt", "tunic", "poncho", "tube"}))
      ->excludes(garments)
      ->group(group)
      ->capture_default_str();
  sub.add_option("--hold", c.hold, "auto: waistbands stay with the body; none: everything is free")
      ->check(CLI::IsMember({"auto", "none"}))
      ->group(group)
      ->capture_default_str();
  sub.add_option(
         "--position", c.position,
         "auto: garments in another unit, with another axis up or beside the body are put on it, with a "
         "warning; as-is: they stay where their files have them")
      ->check(CLI::IsMember({"auto", "as-is"}))
      ->needs(garments)
      ->group(group)
      ->capture_default_str();
  sub.add_option("--tack-mm", c.tack,
                 "pieces of a garment this near to each other stay together: auto (6), off or millimeters")
      ->check(CLI::IsMember({"auto", "off"}) | between(0.0, 100.0))
      ->group(group)
      ->capture_default_str();
  sub.add_option(
         "--order", c.drape.order,
         "names of garment files without their endings, from the body outward, separated by commas: each "
         "is laid over those before it (shirt,trousers tucks the shirt in)")
      ->delimiter(',')
      ->needs(garments)
      ->group(group);
  sub.add_option(
         "--prop", c.props,
         "a thing that stands still beside the body, such as its chair: a mesh in the body's coordinates "
         "and unit, which the cloth meets; may be given several times")
      ->check(not_empty())
      ->allow_extra_args(false)
      ->group(group);
}

void add_output_options(CLI::App& sub, DrapeCommand& c) {
  const auto group = "Output";
  sub.add_option("-o,--output", c.output, "body, ellipsoids and moving cloth, .glb for any glTF viewer")
      ->check(not_empty())
      ->group(group)
      ->capture_default_str();
  sub.add_option("--contact-sheet", c.contact_sheet, "write a PNG with a view of every kept frame")
      ->check(not_empty())
      ->group(group);
  sub.add_option("--film-strip", c.film_strip,
                 "write a PNG with eight moments of the motion in one row, from the front or the left")
      ->check(not_empty())
      ->group(group);
  sub.add_option("--cache", c.cache,
                 "positions of the cloth at the kept frames as a point cache for Blender, Maya and others "
                 "(.pc2 or .mdd), in the input's unit and axes; a second garment goes to NAME_2")
      ->check(not_empty())
      ->group(group);
  sub.add_option("--fit-map", c.fit_map,
                 "color the garments by fit at the end, red tight, blue loose: ease, the gap to the skin, or "
                 "strain")
      ->check(CLI::IsMember({"ease", "strain"}))
      ->group(group);
  sub.add_flag("--no-picture", c.no_picture, "write no PNG beside the output")
      ->excludes("--picture")
      ->group(group);
}

}  // namespace

void add_drape_options(CLI::App& sub, DrapeCommand& command) {
  add_common_options(sub, command.common);
  add_garment_options(sub, command);
  add_motion_options(sub, command);
  add_simulation_options(sub, command);
  add_output_options(sub, command);
}

void add_drape_command(CLI::App& app, int& exit_code, const std::vector<std::string>& command_line) {
  auto command = std::make_shared<DrapeCommand>();
  command->common.command_line = command_line;
  CLI::App* sub = app.add_subcommand("drape", "Drape garments over a body under gravity and wind");
  add_drape_options(*sub, *command);
  sub->footer("Example: bodice drape body.obj dress.obj -o out.glb --frames 120 --wind 0,0,2");
  sub->callback([command, &exit_code] {
    if (!command->no_picture && command->common.picture.empty())
      command->common.picture = std::filesystem::path(command->output).replace_extension(".png").string();
    const auto done = drape(*command);
    exit_code = done ? kExitOk : fail(done.error());
  });
}

}  // namespace bodice::cli
