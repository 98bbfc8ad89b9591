#include "long_run.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <bench_support/or_exit.hpp>
#include "conditions.hpp"

namespace bench {
namespace {

using namespace bodice;
using geometry::Vec3;

constexpr int kKeepOneOf = 10;
constexpr double kDeep_m = 0.002, kEnd_s = 0.5;
constexpr int kSheetColumns = 12;

int frames_of(double seconds) {
  return static_cast<int>(std::lround(seconds / kFrame_s));
}

/// Starts and ends without a jerk.
double smooth(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// The motion over and over, eased into the first pose of `standing`, which holds. A key a frame.
rig::Clip long_clip(const tryon::BodyMotion& playing, const tryon::BodyMotion& standing,
                    const LongRunOptions& options) {
  const rig::Skeleton& skeleton = playing.rig.skeleton;
  std::vector<rig::LocalTransform> now(skeleton.joints.size()), end(now.size());
  rig::sample(skeleton, standing.clip, 0.0, end);
  rig::Clip clip{.name = options.motion, .duration_s = options.moving_s + options.easing_s};
  clip.tracks.resize(now.size());
  for (std::size_t j = 0; j < now.size(); ++j) clip.tracks[j].joint = static_cast<std::uint16_t>(j);
  for (int frame = 0; frame <= frames_of(clip.duration_s); ++frame) {
    const double time_s = frame * kFrame_s;
    rig::sample(skeleton, playing.clip, time_s, now, rig::Playback::kLoop);
    const double share = smooth((time_s - options.moving_s) / options.easing_s);
    for (std::size_t j = 0; j < now.size(); ++j) {
      rig::Track& track = clip.tracks[j];
      track.rotation.time_s.push_back(time_s);
      track.rotation.value.push_back(now[j].rotation.slerp(share, end[j].rotation));
      track.translation.time_s.push_back(time_s);
      track.translation.value.push_back((1.0 - share) * now[j].translation + share * end[j].translation);
    }
  }
  return clip;
}

tryon::BodyMotion motion_of(const engine::Context& context, const MovingOutfit& outfit,
                            const LongRunOptions& options) {
  std::vector<engine::Warning> warnings;
  const tryon::SegmentedSkin& skin = outfit.body->prepared.skin;
  tryon::BodyMotion playing =
      or_exit(tryon::find_motion(context, skin, {.motion = options.motion, .clip = {}}, warnings));
  const tryon::BodyMotion standing =
      or_exit(tryon::find_motion(context, skin, {.motion = "squat", .clip = {}}, warnings));
  playing.clip = long_clip(playing, standing, options);
  return playing;
}

tryon::DrapeResult drape(const engine::Context& context, const MovingOutfit& outfit,
                         const tryon::BodyMotion& motion, const LongRunOptions& options) {
  tryon::DrapeOptions settings = options.drape;
  settings.motion = &motion;
  settings.dt_s = kFrame_s;
  const double seconds = options.moving_s + options.easing_s + options.resting_s;
  settings.frames = std::max(1, frames_of(seconds) / kKeepOneOf) * kKeepOneOf;
  settings.kept_frames = settings.frames / kKeepOneOf + 1;
  return or_exit(tryon::drape(context, outfit.body->prepared, {outfit.garment}, settings));
}

void judge_depths(const LongRunOptions& options, LongRun& run) {
  const std::vector<double>& depth = run.report.penetration_of_frame_m;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double time_s = static_cast<double>(i + 1) * kFrame_s;
    if (depth[i] > kDeep_m) ++run.frames_over_2mm;
    if (time_s <= options.moving_s + options.easing_s && depth[i] > run.deepest_m)
      run.deepest_m = depth[i], run.deepest_s = time_s;
    if (i + static_cast<std::size_t>(frames_of(kEnd_s)) >= depth.size())
      run.rest_m = std::max(run.rest_m, depth[i]);
  }
}

bool repeats(const MovingOutfit& outfit, const tryon::BodyMotion& motion, const LongRunOptions& options,
             std::uint64_t hash) {
  for (const int workers : {1, 2, 3, 7}) {
    const auto executor = engine::make_tbb_executor(workers);
    if (drape({.executor = executor.get()}, outfit, motion, options).report.hash != hash) return false;
  }
  return true;
}

}  // namespace

LongRun run_long(const engine::Context& context, const MovingOutfit& outfit, const LongRunOptions& options) {
  const tryon::BodyMotion motion = motion_of(context, outfit, options);
  tryon::DrapeResult draped = drape(context, outfit, motion, options);
  LongRun run;
  const Judged judged{outfit.body->prepared, motion, outfit.garment.mesh, draped};
  for (std::size_t frame = 1; frame < draped.report.kept.size(); ++frame)
    add_deep_particles(context, judged, frame, run.deep);
  run.report = std::move(draped.report);
  run.garments = std::move(draped.garments);
  run.body_frames = std::move(draped.body_frames);
  judge_depths(options, run);
  const auto& frames = run.garments.front().frames;
  run.drop_m = mean_height(frames.front()) - mean_height(run.body_frames.front()) -
               (mean_height(frames.back()) - mean_height(run.body_frames.back()));
  for (const tryon::KeptFrame& kept : run.report.kept)
    run.proxy_mm += 1e3 * kept.proxy_error.error_m.mean / static_cast<double>(run.report.kept.size());
  if (options.repeat) run.same_hashes = repeats(outfit, motion, options, run.report.hash);
  return run;
}

bool write_sheet(const MovingOutfit& outfit, const LongRun& run, const std::filesystem::path& png) {
  io::Scene scene;
  scene.body = &outfit.body->prepared.skin.input.skin;
  scene.body_frames = run.body_frames;
  scene.garments = run.garments;
  std::vector<std::size_t> frames(run.body_frames.size());
  std::iota(frames.begin(), frames.end(), std::size_t{0});
  const auto written =
      io::write_contact_sheet(scene, frames, kSheetColumns, png, {.width = 150, .height = 240});
  if (!written) std::fprintf(stderr, "%s\n", written.error().sentence().c_str());
  return written.ok();
}

}  // namespace bench
