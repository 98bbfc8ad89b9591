#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include <bodice/engine/message.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/engine/write_file.hpp>
#include <bodice/io/obj.hpp>
#include <bodice/proxy/base_pose.hpp>
#include <bodice/proxy/proxy_surface.hpp>
#include <bodice/tryon/reach.hpp>

#include "options/validators.hpp"
#include "output/body_files.hpp"
#include "output/query_speed.hpp"
#include "run/keep_memory.hpp"
#include "run/prepared_poses.hpp"
#include "run/run.hpp"

namespace bodice::inline v0_1::cli {
namespace {

struct FitCommand {
  CommonOptions common;
  std::string output, surface, measurements, segmentation, heat_map;
  tryon::TailorUnit tailor_unit = tryon::TailorUnit::kMillimeter;
  std::optional<double> surface_mm;
  bool exact_region = false;
  bool no_rig = false;
  PosesToPrepare prepare;
};

/// Reduces the whole body's proxy to what the garment of --region-of can reach, where distances do not
/// change.
engine::Result<void> crop(const CommonOptions& o, const engine::Context& context,
                          std::span<const geometry::TriMesh> garments, tryon::PreparedBody& body) {
  auto near = tryon::within_reach(context, body.fit.proxy, garments, 1e-3 * o.region_margin_mm);
  if (!near) return std::move(near).error();
  body.fit.proxy = std::move(near).value();
  for (fitting::PartFit& part : body.fit.parts)
    part.ellipsoids = static_cast<std::size_t>(
        std::ranges::count(body.fit.proxy.ellipsoids(), part.part, &proxy::ProxyEllipsoid::part));
  std::erase_if(body.fit.parts, [](const fitting::PartFit& part) { return part.ellipsoids == 0; });
  return {};
}

constexpr double kCellsAStature = 300.0, kFewestCells = 10.0;
constexpr double kMostCells = 2000.0;  // across a body; the number of cells goes with the square

/// Checks the cell against the stature, which bounds the memory. It runs before the fit, when the stature is
/// known.
engine::Result<void> check_surface_cell(const FitCommand& command, double stature_m) {
  const double coarsest_mm = 1e3 * stature_m / kFewestCells, finest_mm = 1e3 * stature_m / kMostCells;
  if (!command.surface_mm || (*command.surface_mm >= finest_mm && *command.surface_mm <= coarsest_mm))
    return {};
  return engine::Error{
      engine::ErrorCode::kInvalidArgument,
      engine::message("--surface-mm ", *command.surface_mm, " does not suit a body of ", stature_m, " m."),
      engine::message("Give ", finest_mm, " to ", coarsest_mm, ".")};
}

/// The proxy's surface if it is to be written, or drawn because the ellipsoids do not show the relief.
engine::Result<proxy::ProxySurface> surface_for(const FitCommand& command, const engine::Context& context,
                                                const proxy::BodyProxy& proxy) {
  const bool seen = !command.common.picture.empty() && !proxy.relief().empty();
  if (command.surface.empty() && !seen) return proxy::ProxySurface{};
  const double cell_m = command.surface_mm ? 1e-3 * *command.surface_mm : proxy.stature_m() / kCellsAStature;
  return proxy::proxy_surface(context, proxy, cell_m);
}

/// Indices of vertices are known of OBJ alone.
engine::Result<void> check_segmentation(const FitCommand& command) {
  if (command.segmentation.empty() || extension_of(command.common.body) == ".obj") return {};
  return engine::Error{engine::ErrorCode::kInvalidArgument,
                       "--segmentation lists the vertices of an OBJ body, and BODY is none.",
                       "Give BODY as OBJ."};
}

engine::Result<void> write_outputs(const FitCommand& command, Run& run, const tryon::PreparedBody& body,
                                   const proxy::BasePoses& bases, std::vector<std::string>& written) {
  const proxy::BodyProxy& proxy = body.fit.proxy;
  const auto surface = surface_for(command, run.context(), proxy);
  if (!surface) return surface.error();
  io::Scene scene = scene_of(body);
  if (!proxy.relief().empty() && !surface->mesh.empty()) scene.surface = &*surface;
  using File = const std::string&;
  OutputWriter out(written);
  out.write(command.output, [&](File file) { return proxy::save_with_bases({proxy, bases}, file); });
  out.write(command.common.glb, [&](File file) { return io::write_glb(scene, file); });
  out.write(command.common.picture,
            [&](File file) { return io::write_picture(scene, {}, file, {.show_proxy = true}); });
  out.write(command.surface, [&](File file) { return io::write_obj(surface->mesh, file, proxy.frame()); });
  out.write(command.measurements,
            [&](File file) { return write_measurements(body.skin, command.tailor_unit, file); });
  out.write(command.segmentation,
            [&](File file) { return write_segmentation(run.context(), body.skin, file); });
  out.write(command.heat_map, [&](File file) -> engine::Result<void> {
    const auto limit_m = write_heat_map(run.context(), body, file);
    if (!limit_m) return limit_m.error();
    if (!command.common.quiet && !command.common.json)
      std::printf("heat map    blue: the proxy %g mm beyond the skin; red: the skin %g mm beyond the proxy\n",
                  1e3 * *limit_m, 1e3 * *limit_m);
    return {};
  });
  if (!out.result()) return out.result();
  return run.write_page(body, scene, nullptr, written);
}

engine::Result<proxy::BasePoses> make_bases(const engine::Context& context, const FitCommand& command,
                                            tryon::PreparedBody& body) {
  if (!command.prepare.any()) return proxy::BasePoses{};
  engine::StageTimer timer(context, body.fit.stages, "base poses");
  return prepare_poses(context, body, command.prepare, body.fit.warnings);
}

engine::Error not_of_any(const char* option, const char* what) {
  return {engine::ErrorCode::kInvalidArgument,
          engine::message(option, " does not go with --shape any, which has no ", what, "."),
          "Leave it out."};
}

/// Refuses what only a person has.
engine::Result<void> check_shape(const FitCommand& command) {
  if (command.common.shape != "any") return {};
  if (!command.measurements.empty()) return not_of_any("--measurements", "measurements");
  if (!command.segmentation.empty()) return not_of_any("--segmentation", "regions of a body");
  if (!command.prepare.any()) return {};
  return not_of_any(command.prepare.poses.empty() ? "--motion" : "--poses", "joints to bend");
}

engine::Result<void> fit(const FitCommand& command) {
  keep_freed_memory();
  const CommonOptions& o = command.common;
  Run run(o);
  if (auto ok = run.check_files({{"-o", command.output, {".json", ".bodice"}},
                                 {"--surface", command.surface, {".obj"}},
                                 {"--measurements", command.measurements, {".json", ".yaml", ".yml"}},
                                 {"--segmentation", command.segmentation, {".json"}},
                                 {"--heat-map", command.heat_map, {".png"}}});
      !ok)
    return ok;
  if (auto ok = check_segmentation(command); !ok) return ok;
  if (auto ok = check_shape(command); !ok) return ok;
  auto skin = command.prepare.any() ? run.segment_rigged() : run.segment();
  if (!skin) return std::move(skin).error();
  if (auto ok = check_surface_cell(command, skin->anatomy.stature_m); !ok) return ok;
  const auto garments = run.region_garments(*skin);
  if (!garments) return garments.error();
  auto options = command.exact_region ? fit_options(o) : run.fit_options_for(*skin, *garments);
  if (!options) return std::move(options).error();
  const auto progress = run.progress().callback();
  auto body = command.no_rig
                  ? tryon::fit_proxy(run.context(), std::move(skin).value(), *options, progress)
                  : tryon::fit_bound_proxy(run.context(), std::move(skin).value(), *options, progress);
  if (!body) return std::move(body).error();
  if (command.exact_region)
    if (auto done = crop(o, run.context(), *garments, *body); !done) return done;
  const auto bases = make_bases(run.context(), command, *body);
  if (!bases) return bases.error();
  std::vector<std::string> written;
  if (auto done = write_outputs(command, run, *body, *bases, written); !done) return done;
  auto done = run.finish(*body, nullptr, written, command.exact_region);
  if (done && o.budget_us && !o.quiet && !o.json)
    print_speed(o.tier, *o.budget_us, body->fit.proxy, body->skin.input.skin);
  return done;
}

void add_pose_options(CLI::App& sub, FitCommand& c) {
  const auto group = "Poses";
  auto* poses =
      sub.add_option("--poses", c.prepare.poses,
                     "solve the tables anew in these poses, with which the proxy is as accurate there as at "
                     "rest: motions as in sit,arms-up, or sit@2.5 for a second of one; a body without a rig "
                     "gets one")
          ->delimiter(',')
          ->check(not_empty())
          ->excludes("--no-rig")
          ->group(group);
  poses->needs("--output");
  auto* motion = sub.add_option("--motion", c.prepare.motion.motion,
                                "prepare a whole clip: walk, run, turn, spin, reach, sit, squat, arms-up, "
                                "dance, or a file with a skeleton and clips")
                     ->check(not_empty())
                     ->excludes("--no-rig")
                     ->group(group);
  motion->needs("--output");
  sub.add_option("--clip", c.prepare.motion.clip, "name of the file's clip (default: its first)")
      ->check(not_empty())
      ->needs(motion)
      ->group(group);
}

void add_shape_option(CLI::App& sub, FitCommand& c) {
  sub.add_option("--shape", c.common.shape,
                 "person, or any: a chair, a torso, a dog, a hand; all of the file is fitted, without "
                 "landmarks, with "
                 "parts by clusters of its surface, in meters if neither the file nor --unit gives a unit")
      ->check(CLI::IsMember({"person", "any"}))
      ->needs("BODY")
      ->group("Input")
      ->capture_default_str();
}

void add_output_options(CLI::App& sub, FitCommand& c) {
  const auto group = "Output";
  sub.add_option("-o,--output", c.output, "the proxy: .json, or .bodice for the compact binary")
      ->check(not_empty())
      ->group(group);
  sub.add_option(
         "--glb", c.common.glb,
         "body by part and ellipsoids, those of relief without their tables, for any glTF viewer; meshes "
         "are in the body's own units and axes, and a root node turns them to meters, y up")
      ->check(not_empty())
      ->group(group);
  sub.add_option("--surface", c.surface,
                 "the proxy's surface as triangles (OBJ), for tools that collide with meshes")
      ->check(not_empty())
      ->group(group);
  sub.add_option("--surface-mm", c.surface_mm,
                 "length of that surface's cells: half gives four times the triangles (default: a "
                 "three-hundredth of the stature)")
      ->check(above_zero())
      ->needs("--surface")
      ->group(group);
  sub.add_option("--heat-map", c.heat_map, "the skin from two sides, colored by the proxy's error (PNG)")
      ->check(not_empty())
      ->group(group);
  sub.add_flag("--no-rig", c.no_rig,
               "leave the rig of the file alone: by default the proxy is bound to it, and follows its joints")
      ->group(group);
}

/// Files for garments that are made to measure.
void add_tailor_options(CLI::App& sub, FitCommand& c) {
  const auto group = "Output";
  sub.add_option(
         "--measurements", c.measurements,
         "26 body measurements for garments, for a body that stands with its arms away from the trunk "
         "(.json or .yaml)")
      ->check(not_empty())
      ->group(group);
  const std::map<std::string, tryon::TailorUnit> units = {{"mm", tryon::TailorUnit::kMillimeter},
                                                          {"cm", tryon::TailorUnit::kCentimeter}};
  sub.add_option("--measurements-unit", c.tailor_unit,
                 "mm, or cm as the body files of GarmentCode (default: mm)")
      ->transform(CLI::CheckedTransformer(units))
      ->needs("--measurements")
      ->group(group);
  sub.add_option(
         "--segmentation", c.segmentation,
         "the vertices of an OBJ body in six regions (arms, legs, body, what is inside), as GarmentCode "
         "reads them (.json)")
      ->check(not_empty())
      ->group(group);
}

}  // namespace

void add_fit_command(CLI::App& app, int& exit_code, const std::vector<std::string>& command_line) {
  auto command = std::make_shared<FitCommand>();
  command->common.command_line = command_line;
  CLI::App* sub = app.add_subcommand("fit", "Fit a body proxy of ellipsoids to a body mesh");
  add_output_options(*sub, *command);
  add_tailor_options(*sub, *command);
  add_pose_options(*sub, *command);
  add_common_options(*sub, command->common);
  add_shape_option(*sub, *command);
  sub->add_flag(
         "--region-exact", command->exact_region,
         "fit the whole body and keep the ellipsoids that the garment of --region-of can reach: any "
         "tier then has the distances of the whole body there; the report gives the whole body's accuracy")
      ->needs("--region-of")
      ->group("Speed against accuracy");
  sub->footer("Example: bodice fit body.obj -o proxy.json --target-error-mm 2 --report report.json");
  sub->callback([command, &exit_code] {
    const auto done = fit(*command);
    exit_code = done ? kExitOk : fail(done.error());
  });
}

}  // namespace bodice::cli
