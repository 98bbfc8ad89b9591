#include <bodice/tryon/drape.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/tryon/penetration.hpp>

namespace bodice::tryon {
namespace {

using geometry::Vec3;

constexpr double kInsideTolerance = 1e-6;           ///< of stature: what float particles may be off by
constexpr double kReliefTolerance = 0.05e-3 / 1.7;  ///< of stature: what the collider certifies with relief
constexpr std::size_t kGrain = 256;

/// Frames worth keeping: at most `kept` of 0..frames, evenly spread, first and last included.
std::vector<int> frames_to_keep(int frames, int kept) {
  const int count = std::clamp(kept, 2, frames + 1);
  std::vector<int> keep;
  for (int i = 0; i < count; ++i)
    keep.push_back(static_cast<int>(std::lround(static_cast<double>(frames) * i / (count - 1))));
  keep.erase(std::unique(keep.begin(), keep.end()), keep.end());
  return keep;
}

/// Particles inside the proxy, by the exact level of each ellipsoid in double rather than by the collider
/// that put them there. With relief the surface is not the ellipsoids', so there the collider's distance must
/// do.
std::size_t count_inside(const engine::Context& context, const proxy::BodyProxy& proxy,
                         const collision::Collider& collider, std::span<const Vec3> positions) {
  const bool relief = !proxy.relief().empty();
  const double tolerance_m = (relief ? kReliefTolerance : kInsideTolerance) * proxy.stature_m();
  return engine::ordered_reduce(
      context, positions.size(), kGrain, std::size_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::size_t inside = 0;
        for (std::size_t i = begin; i < end; ++i) {
          if (relief) {
            const Eigen::Vector3f p = (positions[i] - collider.origin()).cast<float>();
            inside += double{collider.query({p.x(), p.y(), p.z()}).signed_distance} < -tolerance_m;
            continue;
          }
          inside += std::ranges::any_of(proxy.ellipsoids(), [&](const proxy::ProxyEllipsoid& e) {
            return geometry::level(e.shape, positions[i]) < 1.0 &&
                   geometry::closest_point(e.shape, positions[i]).signed_distance < -tolerance_m;
          });
        }
        return inside;
      },
      [](std::size_t a, std::size_t b) { return a + b; });
}

void summarize_times(std::vector<double> frame_ms, DrapeReport& report) {
  if (frame_ms.empty()) return;
  std::ranges::sort(frame_ms);
  auto at = [&](double q) {
    return frame_ms[static_cast<std::size_t>(q * static_cast<double>(frame_ms.size() - 1))];
  };
  report.frame_ms_median = at(0.5);
  report.frame_ms_p99 = at(0.99);
  report.frame_ms_max = frame_ms.back();
}

/// Splits the merged positions back into the garments' tracks.
class Recorder {
 public:
  Recorder(const std::vector<WornGarment>& garments, const Wardrobe& all) : first_(all.first_vertex) {
    for (std::size_t g = 0; g < garments.size(); ++g) {
      io::GarmentTrack track;
      track.name = g == 0 ? "cloth" : "cloth_" + std::to_string(g + 1);
      track.mesh = garments[g].mesh;
      tracks_.push_back(std::move(track));
    }
  }
  void keep(std::span<const Vec3> positions, double time_s) {
    for (std::size_t g = 0; g < tracks_.size(); ++g) {
      const auto own = positions.subspan(first_[g], first_[g + 1] - first_[g]);
      tracks_[g].frames.emplace_back(own.begin(), own.end());
      tracks_[g].time_s.push_back(time_s);
    }
  }
  std::vector<io::GarmentTrack> take() { return std::move(tracks_); }

 private:
  std::vector<std::size_t> first_;
  std::vector<io::GarmentTrack> tracks_;
};

engine::Result<void> check(const DrapeOptions& options) {
  const auto bad = [](std::string what, std::string remedy) {
    return engine::Error{engine::ErrorCode::kInvalidArgument, "Drape option " + what + ".",
                         std::move(remedy)};
  };
  if (options.frames < 1) return bad(engine::message("frames is ", options.frames), "Give 1 or more.");
  if (options.kept_frames < 2)
    return bad(engine::message("kept_frames is ", options.kept_frames), "Give 2 or more.");
  if (!(options.dt_s >= 0.0 && std::isfinite(options.dt_s)))
    return bad(engine::message("dt_s is ", options.dt_s), "Give seconds, zero or more.");
  return {};
}

cloth::SolverOptions solver_options(const engine::Context& context, const DrapeOptions& options,
                                    const PreparedBody& body, const geometry::TriMesh& garments) {
  const proxy::BodyProxy& proxy = body.fit.proxy;
  cloth::SolverOptions solver = options.solver;
  solver.thickness_m = options.thickness_m
                           ? *options.thickness_m
                           : fitted_thickness_m(context, garments, *body.skin.distance, proxy.stature_m());
  if (proxy.tier() == proxy::Tier::kPaper) solver.response = collision::Response::kPaper;
  return solver;
}

/// A garment of another body, place or unit simulates just as well, far from the skin, and its report shows
/// nothing inside: these say so.
void warn_of_strangers(const std::vector<WornGarment>& garments, const PreparedBody& body,
                       std::vector<engine::Warning>& warnings) {
  constexpr double kNearStatures = 0.25;                         // a poncho begins above the head
  constexpr double kSmallStatures = 0.03, kLargeStatures = 4.0;  // a wristband, a train
  const double stature_m = body.fit.proxy.stature_m();
  for (const WornGarment& garment : garments) {
    geometry::Box box;
    bool near = false;
    for (const Vec3& p : garment.mesh.positions) {
      if (!p.allFinite()) continue;
      box.extend(p);
      near = near || body.skin.distance->closest_point_within(p, kNearStatures * stature_m);
    }
    const double size_m = box.size().norm();
    if (!(size_m > kSmallStatures * stature_m && size_m < kLargeStatures * stature_m))
      warnings.push_back({"garment-size", garment.name,
                          engine::message("The garment is ", size_m,
                                          " m from corner to corner, beside a body of ", stature_m, " m."),
                          "Check that both are in the same units."});
    else if (!near)
      warnings.push_back({"garment-far", garment.name, "No vertex of the garment is near the body.",
                          "Check that both are in the same place and units."});
  }
}

engine::Result<DrapeResult> simulate(const engine::Context& context, const PreparedBody& body,
                                     const std::vector<WornGarment>& garments, const DrapeOptions& options,
                                     const Progress& progress) {
  const proxy::BodyProxy& proxy = body.fit.proxy;
  if (auto good = check(options); !good) return std::move(good).error();
  const auto joined = join(garments);
  if (!joined) return joined.error();
  const Wardrobe& all = *joined;
  const auto fabric = fabric_or_cotton(options.fabric);
  if (!fabric) return fabric.error();
  const cloth::SolverOptions solver_settings = solver_options(context, options, body, all.mesh);
  auto solver = cloth::Solver::make(all.mesh, all.held, *fabric, solver_settings);
  if (!solver) return std::move(solver).error();
  const collision::Collider collider(proxy);
  solver->move_pins(held_positions(all, collider, solver_settings.thickness_m));

  Recorder recorder(garments, all);
  std::vector<Vec3> positions(all.mesh.positions.size());
  std::vector<double> frame_ms;
  const std::vector<int> keep = frames_to_keep(options.frames, options.kept_frames);
  DrapeResult result;
  DrapeReport& report = result.report;
  report.frames = options.frames;
  report.particles = solver->particles();
  report.thickness_m = solver_settings.thickness_m;
  report.fabric = fabric->name;
  report.dt_s = options.dt_s;
  report.substeps = solver_settings.substeps;
  for (const WornGarment& garment : garments)
    report.garments.push_back({garment.name, garment.mesh.positions.size(), garment.held.size()});
  warn_of_strangers(garments, body, report.warnings);

  std::optional<engine::StageTimer> timer(std::in_place, context, report.stages, "drape");
  solver->positions(positions);
  recorder.keep(positions, 0.0);
  auto next_kept = keep.begin() + 1;
  cloth::FrameReport last;
  for (int frame = 1; frame <= options.frames; ++frame) {
    context.cancel.check();
    const std::int64_t begin_ns = context.clock->now_ns();
    last = solver->step(context, collider, options.dt_s);
    frame_ms.push_back(static_cast<double>(context.clock->now_ns() - begin_ns) * 1e-6);

    solver->positions(positions);
    report.finite = report.finite && last.finite;
    const Penetration depth = penetration(context, *body.skin.distance, positions);
    if (depth.deepest_m > report.penetration_max_m) {
      report.penetration_max_m = depth.deepest_m;
      report.worst_frame = frame;
    }
    report.penetration_over_1mm = depth.over_1mm;
    report.penetration_end_m = depth.deepest_m;
    if (next_kept != keep.end() && *next_kept == frame) {
      recorder.keep(positions, frame * options.dt_s);
      ++next_kept;
    }
    if (progress) progress("drape", static_cast<double>(frame) / options.frames);
  }

  timer.reset();
  summarize_times(std::move(frame_ms), report);
  report.pierced_share = pierced_share(context, *body.skin.distance, positions, all.mesh.triangles);
  report.inside_union = count_inside(context, proxy, collider, positions);
  report.stretch_p95 = last.stretch_p95;
  report.stretch_max = last.stretch_max;
  report.median_speed_m_s = last.median_speed_m_s;
  report.hash = solver->hash();
  report.warnings.insert(report.warnings.end(), solver->warnings().begin(), solver->warnings().end());
  result.garments = recorder.take();
  return result;
}

}  // namespace

engine::Result<DrapeResult> drape(const engine::Context& context, const PreparedBody& body,
                                  const std::vector<WornGarment>& garments, const DrapeOptions& options,
                                  const Progress& progress) {
  return engine::catch_canceled("The drape",
                                [&] { return simulate(context, body, garments, options, progress); });
}

}  // namespace bodice::tryon
