#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include <bodice/io/rig.hpp>
#include <bodice/rigging/clear_arms.hpp>
#include <bodice/rigging/make_rig.hpp>
#include <bodice/rigging/motion.hpp>

#include "options/validators.hpp"
#include "run/run.hpp"

namespace bodice::inline v0_1::cli {
namespace {

struct RigCommand {
  CommonOptions common;
  std::string output = "rigged.glb";
  std::vector<std::string> clips = {"all"};
  bool travel = false;
  std::optional<double> arms_out_deg;  ///< absent: as the body's width needs
};

/// A skin, its rig, and what to report of both.
struct RiggedSkin {
  io::ImportedMesh input;
  rigging::FoundRig found;
  std::vector<body::Part> part;  ///< #V
};

std::vector<std::string> clip_names() {
  std::vector<std::string> names(rigging::kMotionNames.begin(), rigging::kMotionNames.end());
  names.insert(names.end(), {"all", "none"});
  return names;
}

/// The built-in body brings its own rig.
engine::Result<RiggedSkin> rig_builtin(Run& run) {
  const auto options = builtin_body(run.options());
  if (!options) return options.error();
  auto body = synth::make_body(run.context(), *options);
  if (!body) return std::move(body).error();
  RiggedSkin skin;
  skin.input.skin = std::move(body->mesh);
  skin.found.rig = {std::move(body->skeleton), std::move(body->weights), {}};
  skin.part = std::move(body->part);
  return skin;
}

engine::Result<RiggedSkin> rig_file(Run& run) {
  auto segmented = run.segment();
  if (!segmented) return std::move(segmented).error();
  auto found = rigging::make_rig(run.context(), segmented->input.skin, segmented->anatomy);
  if (!found) {
    engine::Error error = std::move(found).error();
    error.message = run.options().body + ": " + error.message;
    return error;
  }
  found->warnings = segmented->warnings;  // those of the import too; anatomy's are among them
  return RiggedSkin{std::move(segmented->input), std::move(found).value(),
                    std::move(segmented->anatomy.part)};
}

engine::Result<void> add_clips(const RigCommand& command, RiggedSkin& skin) {
  rig::Rig& rig = skin.found.rig;
  const auto wanted = [&](const std::string& name) {
    return std::find(command.clips.begin(), command.clips.end(), name) != command.clips.end();
  };
  if (wanted("none")) return {};
  const double arms_out_deg =
      command.arms_out_deg ? *command.arms_out_deg : rigging::clear_arms_deg(skin.input.skin, skin.part, rig);
  const rigging::MotionOptions options{.travel = command.travel,
                                       .arms_out_deg = arms_out_deg,
                                       .floor_m = geometry::bounding_box(skin.input.skin.positions).low.y()};
  for (int i = 0; i < rigging::kMotionCount; ++i) {
    const auto motion = static_cast<rigging::Motion>(i);
    if (!wanted("all") && !wanted(std::string(name(motion)))) continue;
    auto clip = rigging::make_clip(rig.skeleton, motion, options);
    if (!clip) return std::move(clip).error();
    rig.clips.push_back(std::move(clip).value());
  }
  return {};
}

void print_summary(const RiggedSkin& skin) {
  const rig::Rig& rig = skin.found.rig;
  std::printf("body        %s: %zu vertices\n",
              skin.input.file.empty() ? "built-in" : skin.input.file.c_str(),
              skin.input.skin.positions.size());
  std::printf("rig         %zu joints, %zu clips%s\n", rig.skeleton.joints.size(), rig.clips.size(),
              skin.input.file.empty() ? ", made with the body" : "");
  if (!skin.found.stages.empty()) {
    std::printf("ms          ");
    for (std::size_t i = 0; i < skin.found.stages.size(); ++i)
      std::printf("%s%s %.0f", i == 0 ? "" : ", ", skin.found.stages[i].name.c_str(),
                  skin.found.stages[i].ms);
    std::printf("\n");
  }
  for (const engine::Warning& w : skin.found.warnings)
    std::printf("%-11s %s%s%s%s%s\n", w.note ? "note" : "warning", w.part.c_str(), w.part.empty() ? "" : ": ",
                w.message.c_str(), w.remedy.empty() ? "" : " ", w.remedy.c_str());
}

engine::Result<void> make_rigged_file(const RigCommand& command) {
  const CommonOptions& o = command.common;
  Run run(o);
  if (auto ok = run.check_files({{"-o", command.output, {".glb"}}}); !ok) return ok;
  auto skin = o.body.empty() ? rig_builtin(run) : rig_file(run);
  if (!skin) return std::move(skin).error();
  if (auto added = add_clips(command, *skin); !added) return added;
  if (auto saved = io::write_rigged_glb(skin->input.skin, skin->found.rig, command.output); !saved)
    return saved;
  run.progress().clear();
  if (!o.quiet) print_summary(*skin);
  run.list_written({command.output});
  return {};
}

}  // namespace

void add_rig_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<RigCommand>();
  CLI::App* sub =
      app.add_subcommand("rig", "Give a body a skeleton, skin weights and motions, as skinned GLB");
  add_body_option(*sub, command->common, "body mesh in any pose");
  sub->add_option("-o,--output", command->output, "where the rigged body goes, .glb: meters, y up")
      ->check(not_empty())
      ->capture_default_str();
  sub->add_option(
         "--clip", command->clips,
         "motions to add as animations: walk, run, turn, spin, reach, sit, squat, arms-up, dance, all, none")
      ->check(CLI::IsMember(clip_names()))
      ->take_all()
      ->capture_default_str();
  sub->add_flag("--travel", command->travel,
                "walk and run over the floor (default: in place, so that the clip loops)");
  sub->add_option("--arms-out", command->arms_out_deg,
                  "hold the arms this many degrees farther from the body (default: as its width needs)")
      ->check(between(-10.0, 60.0));
  add_input_options(*sub, command->common);
  add_builtin_options(*sub, command->common);
  add_run_options(*sub, command->common);
  sub->footer(
      "A scan needs no rig and no given pose: joints come from its landmarks and parts, weights from its "
      "mesh.\n"
      "Examples: bodice rig scan.obj -o rigged.glb                    every motion, for any tool that opens "
      "GLB\n"
      "          bodice rig scan.obj --clip walk sit                   two of them\n"
      "          bodice rig --height 1.8 --sex male -o man.glb        the built-in body");
  sub->callback([command, &exit_code] {
    const auto done = make_rigged_file(*command);
    exit_code = done ? kExitOk : fail(done.error());
  });
}

}  // namespace bodice::cli
