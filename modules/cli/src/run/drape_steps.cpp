#include "run/drape_steps.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include <bodice/engine/message.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/io/cloth_cache.hpp>
#include <bodice/tryon/place_garment.hpp>
#include <bodice/tryon/wearing.hpp>

#include "options/garment_kinds.hpp"

namespace bodice::inline v0_1::cli {
namespace {

engine::Result<std::vector<tryon::WornGarment>> wear_files(const Run& run, const DrapeCommand& command,
                                                           tryon::SegmentedSkin& skin) {
  std::vector<tryon::WornGarment> worn;
  for (const std::string& file : command.garments) {
    auto garment = io::import_garment(run.context(), file, skin.input.frame);
    if (!garment) return std::move(garment).error();
    skin.warnings.insert(skin.warnings.end(), garment->warnings.begin(), garment->warnings.end());
    if (command.position == "auto") {
      auto placed = tryon::place_garment(
          run.context(),
          {*skin.distance, skin.input.skin, skin.anatomy.stature_m, skin.input.frame.meters_per_unit}, file,
          garment->skin);
      if (!placed) return std::move(placed).error();
      if (*placed) skin.warnings.push_back(**placed);
    }
    worn.push_back({.name = file, .mesh = std::move(garment->skin), .look = std::move(garment->look)});
  }
  return worn;
}

engine::Result<std::vector<tryon::WornGarment>> make_garment(const Run& run, const DrapeCommand& command,
                                                             const tryon::SegmentedSkin& skin) {
  auto garment = tryon::make_garment(run.context(), skin, {.kind = garment_kinds().at(command.made)});
  if (!garment) return std::move(garment).error();
  if (command.hold != "auto") garment->held.clear();
  return std::vector<tryon::WornGarment>{std::move(garment).value()};
}

/// The mean distance between the vertices of two frames, meters.
double apart(std::span<const geometry::Vec3> a, std::span<const geometry::Vec3> b) {
  double sum = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += (a[v] - b[v]).norm();
  return a.empty() ? 0.0 : sum / static_cast<double>(a.size());
}

/// The kept frame that differs most from both the first and the last; the middle one where nothing moves.
std::size_t frame_between(const io::Scene& scene) {
  const auto moved = [&](std::size_t f, std::size_t g) {
    double most = 0.0;
    for (const io::GarmentTrack& track : scene.garments)
      most = std::max(most, apart(track.frames[f], track.frames[g]));
    return scene.body_frames.empty() ? most
                                     : std::max(most, apart(scene.body_frames[f], scene.body_frames[g]));
  };
  const std::size_t last = scene.garments.front().frames.size() - 1;
  std::size_t best = last / 2;
  double most = std::min(moved(best, 0), moved(best, last));
  for (std::size_t f = 1; f < last; ++f)
    if (const double least = std::min(moved(f, 0), moved(f, last)); least > most) most = least, best = f;
  return best;
}

using Frames = std::vector<std::vector<geometry::Vec3>>;

/// The sum over frames and points of the squared motion along an axis, less the motion that all points have
/// in common, square meters.
double motion_along(int axis, const Frames& frames) {
  double sum = 0.0;
  for (std::size_t f = 1; f < frames.size(); ++f) {
    double mean = 0.0, square = 0.0;
    for (std::size_t v = 0; v < frames[f].size(); ++v) {
      const double moved = frames[f][v][axis] - frames[f - 1][v][axis];
      mean += moved, square += moved * moved;
    }
    const auto count = static_cast<double>(frames[f].size());
    sum += square - mean * mean / count;
  }
  return sum;
}

/// Whether a view from the left shows clearly more of the motion than one from the front, as for a body that
/// walks.
bool moves_forward(const Frames& body, const io::GarmentTrack& garment) {
  const Frames& frames = body.empty() ? garment.frames : body;
  return motion_along(2, frames) > 2.0 * motion_along(0, frames);
}

/// Returns the indices of at most eight of the kept frames, evenly spread, the first and the last included.
std::vector<std::size_t> spread_frames(std::size_t kept) {
  constexpr std::size_t kMost = 8;
  std::vector<std::size_t> frames;
  const std::size_t count = std::min(kept, kMost);
  for (std::size_t i = 0; i < count; ++i) frames.push_back(count < 2 ? 0 : i * (kept - 1) / (count - 1));
  return frames;
}

/// The pictures of a drape that its options name.
void write_pictures(const DrapeCommand& command, const io::Scene& scene, const tryon::DrapeResult& draped,
                    OutputWriter& out) {
  const io::GarmentTrack& first = scene.garments.front();
  const std::size_t count = first.frames.size();
  out.write(command.common.picture, [&](const std::string& file) {
    const std::size_t frames[] = {0, frame_between(scene), count - 1};
    io::PictureOptions options;
    if (draped.report.fit_map) options.legend = tryon::legend_of(*draped.report.fit_map);
    return io::write_picture(scene, frames, file, options);
  });
  out.write(command.contact_sheet, [&](const std::string& file) {
    std::vector<std::size_t> frames(count);
    std::iota(frames.begin(), frames.end(), std::size_t{0});
    return io::write_contact_sheet(scene, frames, command.sheet_columns, file, {.width = 240, .height = 320});
  });
  out.write(command.film_strip, [&](const std::string& file) {
    const std::vector<std::size_t> frames = spread_frames(count);
    const io::PictureOptions options = {
        .width = 240, .height = 360, .from_left = moves_forward(draped.body_frames, first)};
    return io::write_contact_sheet(scene, frames, static_cast<int>(frames.size()), file, options);
  });
}

engine::Result<void> write_outputs(Run& run, const DrapeCommand& command, const DressedBody& dressed,
                                   tryon::DrapeResult draped, std::vector<std::string>& written) {
  io::Scene scene = scene_of(dressed.body);
  if (draped.proxy) scene.proxy = &*draped.proxy;
  for (const tryon::PreparedBody& prop : dressed.props)
    scene.things.push_back({scene.things.empty() ? "prop" : engine::message("prop_", scene.things.size() + 1),
                            &prop.skin.input.skin, prop.skin.anatomy.part});
  scene.rig = dressed.motion ? &dressed.motion->rig : nullptr;
  scene.proxy_frames = draped.proxy_frames;
  scene.garments = std::move(draped.garments);
  scene.body_frames = draped.body_frames;
  OutputWriter out(written);
  out.write(command.output, [&](const std::string& file) { return io::write_glb(scene, file); });
  write_pictures(command, scene, draped, out);
  for (std::size_t k = 0; !command.cache.empty() && k < scene.garments.size(); ++k)
    out.write(cache_file(command, k), [&](const std::string& file) {
      return io::write_cloth_cache(scene.garments[k], scene.frame, file);
    });
  if (!out.result()) return out.result();
  if (!command.thumbnail.empty()) {  // no option names it, so that it is not listed
    const std::size_t last[] = {scene.garments.front().frames.size() - 1};
    if (auto saved = io::write_contact_sheet(scene, last, 1, command.thumbnail, kThumbnail); !saved)
      return saved;
  }
  return run.write_page(dressed.body, scene, &draped.report, written);
}

/// The frames that play a clip once, when the user gives no number.
engine::Result<int> frames_of(const rig::Clip& clip, double dt_s) {
  if (!(dt_s > 0.0)) return 1;
  const double frames = std::ceil(clip.duration_s / dt_s - 1e-6);
  if (frames > kMostFrames)
    return engine::Error{engine::ErrorCode::kInvalidArgument,
                         engine::message("The clip '", clip.name, "' takes ", clip.duration_s,
                                         " s, which are over ", kMostFrames, " frames of ", dt_s, " s."),
                         "Give --frames, or a longer --dt."};
  return std::max(1, static_cast<int>(frames));
}

/// The distance of --tack-mm, which is checked already.
double tack_m(const std::string& text) {
  double mm = 1e3 * tryon::kTackWithin_m;
  if (text == "off") return 0.0;
  if (text != "auto") std::from_chars(text.data(), text.data() + text.size(), mm);
  return 1e-3 * mm;
}

engine::Result<tryon::DrapeOptions> drape_options(const DrapeCommand& command, const geometry::Frame& frame,
                                                  const tryon::BodyMotion* motion) {
  tryon::DrapeOptions options = command.drape;
  options.prepare_clip = !command.no_prepare;
  options.motion = motion;
  if (command.frames) {
    options.frames = *command.frames;
  } else if (motion) {
    const auto frames = frames_of(motion->clip, options.dt_s);
    if (!frames) return frames.error();
    options.frames = *frames;
  }
  auto fabric = cloth::find_fabric(command.fabric);
  if (!fabric) return std::move(fabric).error();
  options.fabric = std::move(fabric).value();
  options.solver.seed = command.common.seed;
  if (!command.fit_map.empty())
    options.fit_map = command.fit_map == "ease" ? tryon::FitMap::kEase : tryon::FitMap::kStrain;
  options.tack_m = tack_m(command.tack);
  if (command.thickness_mm) options.thickness_m = *command.thickness_mm * 1e-3;
  if (!command.wind_m_s.empty())
    options.solver.environment.wind_m_s =
        frame.rotation() * geometry::Vec3(command.wind_m_s[0], command.wind_m_s[1], command.wind_m_s[2]);
  return options;
}

}  // namespace

std::string cache_file(const DrapeCommand& command, std::size_t k) {
  std::filesystem::path file = command.cache;
  if (k > 0)
    file.replace_filename(file.stem().string() + "_" + std::to_string(k + 1) + file.extension().string());
  return file.string();
}

engine::Result<tryon::SegmentedSkin> read_body(Run& run, const DrapeCommand& command) {
  return command.moves() ? run.segment_rigged() : run.segment();
}

engine::Result<std::optional<tryon::BodyMotion>> find_motion(const Run& run, const DrapeCommand& command,
                                                             tryon::SegmentedSkin& skin) {
  if (!command.moves()) return std::optional<tryon::BodyMotion>();
  auto motion = tryon::find_motion(run.context(), skin, command.motion, skin.warnings);
  if (!motion) return std::move(motion).error();
  return std::optional(std::move(motion).value());
}

engine::Result<std::vector<tryon::WornGarment>> dress(const Run& run, const DrapeCommand& command,
                                                      tryon::SegmentedSkin& skin) {
  if (command.garments.empty()) return make_garment(run, command, skin);
  auto worn = wear_files(run, command, skin);
  if (worn && command.hold == "auto")
    for (tryon::WornGarment& garment : *worn) garment.held = tryon::held_vertices(garment.mesh, skin);
  return worn;
}

engine::Result<tryon::PreparedBody> fit_body(Run& run, tryon::SegmentedSkin skin, bool bound) {
  const auto region = run.region_garments(skin);
  if (!region) return region.error();
  const auto options = run.fit_options_for(skin, *region);
  if (!options) return options.error();
  const auto progress = run.progress().callback();
  return bound ? tryon::fit_bound_proxy(run.context(), std::move(skin), *options, progress)
               : tryon::fit_proxy(run.context(), std::move(skin), *options, progress);
}

engine::Result<std::vector<tryon::PreparedBody>> read_props(Run& run, const DrapeCommand& command,
                                                            tryon::PreparedBody& body) {
  std::vector<tryon::PreparedBody> props;
  for (const std::string& file : command.props) {
    auto prop =
        tryon::read_prop(run.context(), file, body, fit_options(command.common), run.progress().callback());
    if (!prop) return std::move(prop).error();
    for (engine::Warning warning : prop->all_warnings()) {
      warning.message = file + ": " + warning.message;
      body.fit.warnings.push_back(std::move(warning));
    }
    props.push_back(std::move(prop).value());
  }
  return props;
}

engine::Result<tryon::DrapeReport> drape_and_write(Run& run, const DrapeCommand& command,
                                                   DressedBody& dressed, std::vector<std::string>& written) {
  tryon::BodyMotion* const motion = dressed.motion ? &*dressed.motion : nullptr;
  auto options = drape_options(command, dressed.body.skin.input.frame, motion);
  if (!options) return options.error();
  options->props = dressed.props;
  std::vector<engine::StageTime> whole;
  auto draped = [&] {
    const engine::StageTimer timer(run.context(), whole, "drape with set-up");
    return tryon::drape(run.context(), dressed.body, dressed.worn, *options, run.progress().callback());
  }();
  if (!draped) return std::move(draped).error();
  for (const engine::StageTime& stage : draped->report.stages) whole.front().ms -= stage.ms;
  draped->report.stages.push_back({"set-up and judging", whole.front().ms});
  tryon::DrapeReport report = draped->report;
  if (motion) motion->rig.clips = {std::move(draped->clip)};
  if (auto done = write_outputs(run, command, dressed, std::move(draped).value(), written); !done)
    return std::move(done).error();
  return report;
}

}  // namespace bodice::cli
