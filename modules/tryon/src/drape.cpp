#include <bodice/tryon/drape.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/tryon/penetration.hpp>

#include "misplaced_garments.hpp"
#include "recorder.hpp"

namespace bodice::tryon {
namespace {

using geometry::Vec3;

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

/// The part of the report that is known before the first frame.
DrapeReport describe(const std::vector<WornGarment>& garments, const DrapeOptions& options,
                     const cloth::SolverOptions& solver, const cloth::Fabric& fabric) {
  DrapeReport report;
  report.frames = options.frames;
  report.dt_s = options.dt_s;
  report.thickness_m = solver.thickness_m;
  report.substeps = solver.substeps;
  report.fabric = fabric.name;
  for (const WornGarment& garment : garments)
    report.garments.push_back({garment.name, garment.mesh.positions.size(), garment.held.size()});
  return report;
}

void add_frame(int frame, const Penetration& depth, DrapeReport& report) {
  if (depth.deepest_m > report.penetration_max_m) {
    report.penetration_max_m = depth.deepest_m;
    report.worst_frame = frame;
  }
  report.penetration_over_1mm = depth.over_1mm;
  report.penetration_end_m = depth.deepest_m;
}

void add_cloth(const cloth::FrameReport& last, DrapeReport& report) {
  report.stretch_p95 = last.stretch_p95;
  report.stretch_max = last.stretch_max;
  report.median_speed_m_s = last.median_speed_m_s;
}

/// The cloth of a drape, what keeps it out of the body, and the skin that it is measured against.
struct Dressed {
  cloth::Solver& solver;
  const collision::Collider& collider;
  const geometry::MeshDistance& skin;
};

/// Runs all frames and leaves the last positions in `positions` (#vertices of all garments).
void run_frames(const engine::Context& context, const Dressed& dressed, const DrapeOptions& options,
                std::span<Vec3> positions, const std::function<void(int frame)>& after_frame,
                DrapeReport& report) {
  const engine::StageTimer timer(context, report.stages, "drape");
  std::vector<double> frame_ms;
  dressed.solver.positions(positions);
  after_frame(0);
  for (int frame = 1; frame <= options.frames; ++frame) {
    context.cancel.check();
    const std::int64_t begin_ns = context.clock->now_ns();
    const cloth::FrameReport step = dressed.solver.step(context, dressed.collider, options.dt_s);
    frame_ms.push_back(static_cast<double>(context.clock->now_ns() - begin_ns) * 1e-6);

    dressed.solver.positions(positions);
    report.finite = report.finite && step.finite;
    add_frame(frame, penetration(context, dressed.skin, positions), report);
    add_cloth(step, report);
    after_frame(frame);
  }
  summarize_times(std::move(frame_ms), report);
}

engine::Result<DrapeResult> simulate(const engine::Context& context, const PreparedBody& body,
                                     const std::vector<WornGarment>& garments, const DrapeOptions& options,
                                     const Progress& progress) {
  if (auto good = check(options); !good) return std::move(good).error();
  const auto all = join(garments);
  if (!all) return all.error();
  const auto fabric = fabric_or_cotton(options.fabric);
  if (!fabric) return fabric.error();
  const cloth::SolverOptions settings = solver_options(context, options, body, all->mesh);
  auto solver = cloth::Solver::make(all->mesh, all->held, *fabric, settings);
  if (!solver) return std::move(solver).error();
  const collision::Collider collider(body.fit.proxy);
  solver->move_pins(held_positions(*all, collider, settings.thickness_m));

  DrapeReport report = describe(garments, options, settings, *fabric);
  report.particles = solver->particles();
  warn_of_misplaced(garments, body, report.warnings);
  Recorder recorder(garments, *all, frames_to_keep(options.frames, options.kept_frames));
  std::vector<Vec3> positions(all->mesh.positions.size());
  const auto after_frame = [&](int frame) {
    recorder.offer(frame, positions, frame * options.dt_s);
    if (progress && frame > 0) progress("drape", static_cast<double>(frame) / options.frames);
  };
  run_frames(context, {*solver, collider, *body.skin.distance}, options, positions, after_frame, report);

  report.pierced_share = pierced_share(context, *body.skin.distance, positions, all->mesh.triangles);
  report.inside_union = count_inside(context, body.fit.proxy, positions);
  report.hash = solver->hash();
  report.warnings.insert(report.warnings.end(), solver->warnings().begin(), solver->warnings().end());
  return DrapeResult{.garments = recorder.take(), .report = std::move(report)};
}

}  // namespace

engine::Result<DrapeResult> drape(const engine::Context& context, const PreparedBody& body,
                                  const std::vector<WornGarment>& garments, const DrapeOptions& options,
                                  const Progress& progress) {
  return engine::catch_canceled("The drape",
                                [&] { return simulate(context, body, garments, options, progress); });
}

}  // namespace bodice::tryon
