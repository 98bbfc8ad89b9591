#include <bodice/tryon/drape.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/rig/loop.hpp>
#include <bodice/tryon/base_pose.hpp>
#include <bodice/tryon/layers.hpp>
#include <bodice/tryon/penetration.hpp>

#include "drape/check_drape.hpp"
#include "drape/drape_frames.hpp"
#include "drape/drape_report.hpp"
#include "drape/recorder.hpp"
#include "garment/misplaced_garments.hpp"
#include "garment/start.hpp"
#include "measure/crossings.hpp"
#include "measure/prop_start.hpp"
#include "motion/moving_body.hpp"
#include "motion/moving_thickness.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

constexpr double kLayersOfGap = 2.0;  // the distance of separated layers, in gaps between layers

double ramp_s(const engine::Context& context, const DrapeOptions& options, const PreparedBody& body) {
  if (!options.motion) return 0.0;
  return options.ramp_s ? *options.ramp_s
                        : suggested_ramp_s(context, *options.motion, body.skin.input.skin.positions);
}

/// The base poses along the part of the clip that is played; none without a motion or without relief.
engine::Result<proxy::BasePoses> prepare_clip(const engine::Context& context, const DrapeOptions& options,
                                              const PreparedBody& body, const Progress& progress,
                                              std::vector<engine::StageTime>& stages) {
  if (!options.motion || !options.prepare_clip || body.fit.proxy.relief().empty()) return proxy::BasePoses{};
  const engine::StageTimer timer(context, stages, "prepare");
  return make_base_poses(context, body.fit.proxy, body.skin, *options.motion, options.frames * options.dt_s,
                         progress);
}

/// The given thickness, or the one that the body at rest and the poses of its clip need.
engine::Result<double> thickness_m(const engine::Context& context, const DrapeOptions& options,
                                   const PreparedBody& body, const geometry::TriMesh& garments,
                                   const proxy::BasePoses& bases) {
  if (options.thickness_m) return *options.thickness_m;
  const MovingBody standing = MovingBody::make(body.skin, body.fit.proxy, false).value();
  const double at_rest_m = known_thickness_m(context, garments, *body.skin.distance, standing.collider());
  if (!options.motion) return at_rest_m;
  const auto moving_m = moving_thickness_m(context, garments, body, *options.motion, bases);
  if (!moving_m) return moving_m.error();
  return std::max(at_rest_m, *moving_m);
}

engine::Result<cloth::SolverOptions> solver_options(const engine::Context& context,
                                                    const DrapeOptions& options, const PreparedBody& body,
                                                    const geometry::TriMesh& garments,
                                                    const proxy::BasePoses& bases) {
  const auto thickness = thickness_m(context, options, body, garments, bases);
  if (!thickness) return thickness.error();
  cloth::SolverOptions solver = options.solver;
  solver.thickness_m = *thickness;
  if (body.fit.proxy.tier() == proxy::Tier::kPaper) solver.response = collision::Response::kPaper;
  return solver;
}

/// Measures the cloth where it is at the end, against the body and against the proxy that it met.
void measure_end(const engine::Context& context, std::span<const Vec3> positions, const DrapeOptions& options,
                 const proxy::BodyProxy& proxy, Scene& scene, DrapeReport& report) {
  MovingBody& moving = scene.contact_body;
  const std::vector<geometry::Triangle>& triangles = scene.all.mesh.triangles;
  report.pierced_share = pierced_share(context, moving.distance(context), positions, triangles);
  add_cloth(context, positions, triangles, options.props, report.props);
  report.inside_union = moving.moves() ? count_inside(context, proxy, moving.poser()->posed(), positions)
                                       : count_inside(context, proxy, positions);
  report.hash = scene.solver.hash();
  const auto& warnings = scene.solver.warnings();
  report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
}

engine::Result<DrapeResult> simulate(const engine::Context& context, const PreparedBody& body,
                                     const std::vector<WornGarment>& garments, const DrapeOptions& options,
                                     const Progress& progress) {
  auto all = join(garments);
  if (!all) return all.error();
  if (auto good = check(garments, body); !good) return std::move(good).error();
  const SeparatedLayers separated =
      separate_layers(context, *body.skin.distance, kLayersOfGap * options.solver.layer_gap_m, all->mesh);
  const auto tacked = add_tacks(context, garments, options.tack_m, *all);
  const auto fabric = fabric_or_cotton(options.fabric);
  if (!fabric) return fabric.error();
  std::vector<engine::StageTime> stages;
  const auto bases = prepare_clip(context, options, body, progress, stages);
  if (!bases) return bases.error();
  const auto settings = solver_options(context, options, body, all->mesh, *bases);
  if (!settings) return settings.error();
  auto solver = cloth::Solver::make(all->mesh, all->held, *fabric, *settings, all->tacks);
  if (!solver) return std::move(solver).error();

  DrapeResult result;
  DrapeReport& report = result.report;
  report = describe(garments, options, *settings, *fabric);
  report.stages = std::move(stages);
  report.base_poses = bases->size();
  for (std::size_t g = 0; g < garments.size(); ++g) report.garments[g].tacked = tacked[g];
  report.particles = solver->particles();
  report.crossings_start = separated.before;
  report.crossings_separated = separated.before - separated.after;
  report.ramp_s = ramp_s(context, options, body);
  warn_of_misplaced(garments, body, report.warnings);
  if (auto joined = join_props(context, all->mesh.positions, body, options.props, result); !joined)
    return std::move(joined).error();
  const proxy::BodyProxy& proxy = result.proxy ? *result.proxy : body.fit.proxy;
  auto scene = make_scene(*all, *solver, body, proxy, options.motion != nullptr, *bases);
  if (!scene) return std::move(scene).error();
  MovingBody& moving = scene->contact_body;
  report.lifted_m = lift_out(context, body.skin, moving.collider(), settings->thickness_m, *all, *solver);
  Recorder recorder(garments, *all, frames_to_keep(options.frames, options.kept_frames));
  Drape drape(context, options, *scene, recorder, result);
  std::optional<engine::StageTimer> timer(std::in_place, context, report.stages, "drape");
  drape.hold(settings->thickness_m, options.motion ? &options.motion->rig.weights : nullptr, body);
  if (auto done = drape.ramp(); !done) return std::move(done).error();
  if (auto done = drape.run(progress); !done) return std::move(done).error();
  drape.measure_garments(garments, body, *fabric);
  report.crossings_end = measure_crossings(
      *all, garments, drape.positions(),
      {moving.skin(context), body.skin.anatomy.part, moving.distance(context)}, report.warnings);
  timer.reset();
  measure_end(context, drape.positions(), options, proxy, *scene, report);
  result.garments = recorder.take();
  result.bases = *bases;
  if (options.fit_map) {
    report.fit_map = fit_scale(*options.fit_map, *fabric);
    drape.color(*report.fit_map, garments, result.garments);
  }
  return result;
}

/// Simulates with a clip that is closed if it loops, and returns the clip that was played.
engine::Result<DrapeResult> play_and_simulate(const engine::Context& context, const PreparedBody& body,
                                              const std::vector<WornGarment>& garments,
                                              const DrapeOptions& options, const Progress& progress) {
  DrapeOptions with = options;
  std::optional<BodyMotion> closed;
  if (options.motion && options.loop)
    with.motion = &closed.emplace(closed_loop(context, *options.motion, body.skin.input.skin.positions));
  auto result = simulate(context, body, garments, with, progress);
  if (result && closed)
    result->clip = rig::repeat(closed->clip, options.frames * options.dt_s);
  else if (result && options.motion)
    result->clip = options.motion->clip;
  return result;
}

}  // namespace

engine::Result<DrapeResult> drape(const engine::Context& context, const PreparedBody& body,
                                  const std::vector<WornGarment>& garments, const DrapeOptions& options,
                                  const Progress& progress) {
  return engine::catch_canceled("The drape", [&]() -> engine::Result<DrapeResult> {
    if (auto good = check(options, body); !good) return std::move(good).error();
    if (options.order.empty()) return play_and_simulate(context, body, garments, options, progress);
    const auto ordered = order_layers(context, *body.skin.distance, options.order, garments,
                                      kLayersOfGap * options.solver.layer_gap_m);
    return ordered ? play_and_simulate(context, body, *ordered, options, progress) : ordered.error();
  });
}

}  // namespace bodice::tryon
