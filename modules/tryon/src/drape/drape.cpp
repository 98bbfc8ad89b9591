#include <bodice/tryon/drape.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/engine/stage_timer.hpp>
#include <bodice/geometry/crossings.hpp>
#include <bodice/rig/loop.hpp>
#include <bodice/tryon/garment_reach.hpp>
#include <bodice/tryon/layers.hpp>
#include <bodice/tryon/penetration.hpp>

#include "drape/check_drape.hpp"
#include "drape/drape_report.hpp"
#include "drape/recorder.hpp"
#include "garment/misplaced_garments.hpp"
#include "garment/start.hpp"
#include "measure/crossings.hpp"
#include "measure/fit_warnings.hpp"
#include "measure/prop_start.hpp"
#include "motion/moving_body.hpp"
#include "motion/moving_thickness.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

constexpr double kLayersOfGap = 2.0;  // garments are laid over others at so many gaps

double ramp_s(const engine::Context& context, const DrapeOptions& options, const PreparedBody& body) {
  if (!options.motion) return 0.0;
  return options.ramp_s ? *options.ramp_s
                        : suggested_ramp_s(context, *options.motion, body.skin.input.skin.positions);
}

/// Returns the given thickness, or the one that the body at rest and the poses of its clip need.
engine::Result<double> thickness_m(const engine::Context& context, const DrapeOptions& options,
                                   const PreparedBody& body, const geometry::TriMesh& garments) {
  if (options.thickness_m) return *options.thickness_m;
  const MovingBody standing = MovingBody::make(body.skin, body.fit.proxy, false).value();
  const double at_rest_m = known_thickness_m(context, garments, *body.skin.distance, standing.collider());
  if (!options.motion) return at_rest_m;
  const auto moving_m = moving_thickness_m(context, garments, body, *options.motion);
  if (!moving_m) return moving_m.error();
  return std::max(at_rest_m, *moving_m);
}

engine::Result<cloth::SolverOptions> solver_options(const engine::Context& context,
                                                    const DrapeOptions& options, const PreparedBody& body,
                                                    const geometry::TriMesh& garments) {
  const auto thickness = thickness_m(context, options, body, garments);
  if (!thickness) return thickness.error();
  cloth::SolverOptions solver = options.solver;
  solver.thickness_m = *thickness;
  if (body.fit.proxy.tier() == proxy::Tier::kPaper) solver.response = collision::Response::kPaper;
  return solver;
}

/// The cloth, and the body twice: the one that the cloth meets, of which tables beyond the garments' reach
/// stay as at rest; and the whole of it, which the report judges.
struct Scene {
  const Wardrobe& all;
  cloth::Solver& solver;
  MovingBody met, judged;
};

engine::Result<Scene> make_scene(const Wardrobe& all, cloth::Solver& solver, const PreparedBody& body,
                                 const proxy::BodyProxy& with_props, bool moves) {
  auto met = MovingBody::make(body.skin, with_props, moves);
  if (!met) return std::move(met).error();
  auto judged = MovingBody::make(body.skin, body.fit.proxy, moves);
  if (!judged) return std::move(judged).error();
  return Scene{all, solver, std::move(met).value(), std::move(judged).value()};
}

/// A drape in progress: cloth, body, and what is recorded of them.
class Drape {
 public:
  Drape(const engine::Context& context, const DrapeOptions& options, Scene& scene, Recorder& recorder,
        DrapeResult& result)
      : context_(context),
        options_(options),
        scene_(scene),
        recorder_(recorder),
        result_(result),
        positions_(scene.all.mesh.positions),
        reach_(positions_) {
    if (!options.motion) return;
    player_.emplace(*options.motion, result.report.ramp_s,
                    options.loop ? rig::Playback::kLoop : rig::Playback::kClamp);
    joints_.resize(options.motion->rig.skeleton.joints.size());
  }

  /// Puts pins on the body where it stands, in the bind pose.
  void hold(double thickness_m, const rig::SkinWeights* skin_weights, const PreparedBody& body) {
    held_ = held_positions(scene_.all, scene_.met.collider(), thickness_m);
    if (skin_weights)
      held_weights_ = attach_to_skin(body.skin.input.skin, *body.skin.distance, *skin_weights, held_);
    posed_ = held_;
    scene_.solver.move_pins(posed_);
  }

  /// Brings a body that moves from the bind pose to the clip's first frame.
  engine::Result<void> ramp() {
    const double ramp_s = result_.report.ramp_s;
    const int steps = static_cast<int>(std::ceil(ramp_s / kRampStep_s));
    if (steps == 0) return pose(0.0, 0.0);  // without a ramp the body jumps to the first frame
    for (int step = 1; step <= steps; ++step) {
      context_.cancel.check();
      if (auto posed = pose(-ramp_s * (1.0 - static_cast<double>(step) / steps), ramp_s / steps); !posed)
        return posed;
      scene_.solver.step(context_, scene_.met.collider(), ramp_s / steps);
      scene_.solver.positions(positions_);
    }
    return {};
  }

  /// Runs all frames and measures each.
  engine::Result<void> run(const Progress& progress) {
    DrapeReport& report = result_.report;
    std::vector<double> frame_ms;
    scene_.solver.positions(positions_);
    offer(0, scene_.met.moves() ? penetration(context_, scene_.met.distance(context_), positions_)
                                : Penetration{});
    for (int frame = 1; frame <= options_.frames; ++frame) {
      context_.cancel.check();
      const std::int64_t begin_ns = context_.clock->now_ns();
      if (auto posed = pose(frame * options_.dt_s, options_.dt_s); !posed) return posed;
      const cloth::FrameReport step = scene_.solver.step(context_, scene_.met.collider(), options_.dt_s);
      frame_ms.push_back(static_cast<double>(context_.clock->now_ns() - begin_ns) * 1e-6);

      scene_.solver.positions(positions_);
      report.finite = report.finite && step.finite;
      const Penetration depth = penetration(context_, scene_.met.distance(context_), positions_);
      add_frame(frame, depth, report);
      add_frame(context_, frame, positions_, options_.props, report.props);
      add_cloth(step, report);
      offer(frame, depth);
      if (progress) progress("drape", static_cast<double>(frame) / options_.frames);
    }
    summarize_times(std::move(frame_ms), report);
    return {};
  }

  std::span<const Vec3> positions() const { return positions_; }

  /// Measures how each garment lies now, and warns of what does not fit.
  void measure_garments(const std::vector<WornGarment>& garments, const PreparedBody& body,
                        const cloth::Fabric& fabric) {
    for (std::size_t g = 0; g < garments.size(); ++g) {
      const WornGarment& garment = garments[g];
      const std::span<const Vec3> now =
          positions().subspan(scene_.all.first_vertex[g], garment.mesh.positions.size());
      std::vector<PartEase>& ease = result_.report.garments[g].ease;
      ease = measure_ease(context_, scene_.met.skin(context_), body.skin.anatomy.part,
                          scene_.met.distance(context_), garment.mesh, now);
      const std::vector<PartEase> start =
          measure_ease(context_, body.skin.input.skin, body.skin.anatomy.part, *body.skin.distance,
                       garment.mesh, garment.mesh.positions);
      warn_of_fit({garment, start, ease, now, body.skin.anatomy.up, !scene_.met.moves()}, fabric,
                  result_.report.warnings);
    }
  }

  /// Colors the tracks by how the garments lie now.
  void color(const FitScale& scale, const std::vector<WornGarment>& garments,
             std::vector<io::GarmentTrack>& tracks) {
    for (std::size_t g = 0; g < garments.size(); ++g) {
      const std::span<const Vec3> now =
          positions().subspan(scene_.all.first_vertex[g], garments[g].mesh.positions.size());
      tracks[g].colors = fit_colors(scale.map == FitMap::kEase
                                        ? ease_of_vertices(context_, scene_.met.distance(context_), now)
                                        : strain_of_vertices(garments[g].mesh, now),
                                    scale);
    }
  }

 private:
  static constexpr double kRampStep_s = 1.0 / 60.0;

  engine::Result<void> pose(double time_s, double dt_s) {
    if (!scene_.met.moves()) return {};
    player_->joints(time_s, joints_);
    if (auto posed = scene_.met.pose(context_, joints_, dt_s, {.within = reach_.boxes(positions_)}); !posed)
      return engine::Error{posed.error().code,
                           engine::message("At second ", time_s, " of the clip '", options_.motion->clip.name,
                                           "': ", posed.error().message),
                           posed.error().remedy};
    scene_.met.carry(held_, held_weights_, posed_);
    scene_.solver.move_pins(posed_);
    return {};
  }

  void offer(int frame, const Penetration& depth) {
    const double time_s = frame * options_.dt_s;
    if (!recorder_.offer(frame, positions_, time_s) || !scene_.met.moves()) return;
    // The body that judges takes the pose of the body that the cloth met in this frame.
    static_cast<void>(scene_.judged.pose(context_, joints_, 0.0));
    const geometry::MeshDistance& skin = scene_.met.distance(context_);
    result_.body_frames.push_back(scene_.met.skin(context_).positions);
    result_.proxy_frames.push_back(scene_.met.poser()->posed().shapes);
    result_.report.kept.push_back(
        {.time_s = time_s,
         .proxy_error = measure_proxy_error(context_, scene_.judged.collider(), scene_.met.skin(context_),
                                            skin, kNearSkin_m),
         .penetration_max_m = depth.deepest_m,
         .inside = cloth_inside(context_, skin, positions_, scene_.all.mesh.triangles, kVisibleDepth_m)});
  }

  static constexpr double kNearSkin_m = 0.03, kVisibleDepth_m = 0.5e-3;

  const engine::Context& context_;
  const DrapeOptions& options_;
  Scene& scene_;
  Recorder& recorder_;
  DrapeResult& result_;
  std::optional<MotionPlayer> player_;  // of a body that moves
  std::vector<rig::Affine> joints_;     // #J
  std::vector<Vec3> positions_;         // #vertices of all garments
  GarmentReach reach_;                  // of positions_
  std::vector<Vec3> held_, posed_;      // pins in the bind pose and in this one
  rig::SkinWeights held_weights_;
};

engine::Result<DrapeResult> simulate(const engine::Context& context, const PreparedBody& body,
                                     const std::vector<WornGarment>& garments, const DrapeOptions& options,
                                     const Progress& progress) {
  auto all = join(garments);
  if (!all) return all.error();
  const auto tacked = add_tacks(context, garments, options.tack_m, *all);
  const auto fabric = fabric_or_cotton(options.fabric);
  if (!fabric) return fabric.error();
  const auto settings = solver_options(context, options, body, all->mesh);
  if (!settings) return settings.error();
  auto solver = cloth::Solver::make(all->mesh, all->held, *fabric, *settings, all->tacks);
  if (!solver) return std::move(solver).error();

  DrapeResult result;
  DrapeReport& report = result.report;
  report = describe(garments, options, *settings, *fabric);
  for (std::size_t g = 0; g < garments.size(); ++g) report.garments[g].tacked = tacked[g];
  report.particles = solver->particles();
  report.crossings_start = geometry::find_crossings(all->mesh.positions, all->mesh.triangles).size();
  report.ramp_s = ramp_s(context, options, body);
  warn_of_misplaced(garments, body, report.warnings);
  if (auto met = meet_props(context, all->mesh.positions, body, options.props, result); !met)
    return std::move(met).error();
  const proxy::BodyProxy& met = result.proxy ? *result.proxy : body.fit.proxy;
  auto scene = make_scene(*all, *solver, body, met, options.motion != nullptr);
  if (!scene) return std::move(scene).error();
  MovingBody& moving = scene->met;
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
  report.pierced_share =
      pierced_share(context, moving.distance(context), drape.positions(), all->mesh.triangles);
  add_cloth(context, drape.positions(), all->mesh.triangles, options.props, report.props);
  report.inside_union = moving.moves()
                            ? count_inside(context, met, moving.poser()->posed(), drape.positions())
                            : count_inside(context, met, drape.positions());
  report.hash = solver->hash();
  report.warnings.insert(report.warnings.end(), solver->warnings().begin(), solver->warnings().end());
  result.garments = recorder.take();
  if (options.fit_map) {
    report.fit_map = fit_scale(*options.fit_map, *fabric);
    drape.color(*report.fit_map, garments, result.garments);
  }
  return result;
}

/// Closes a clip that is played in a loop, and keeps what was played.
engine::Result<DrapeResult> play_and_simulate(const engine::Context& context, const PreparedBody& body,
                                              const std::vector<WornGarment>& garments,
                                              const DrapeOptions& options, const Progress& progress) {
  if (!options.motion) return simulate(context, body, garments, options, progress);
  if (!options.loop) {
    auto result = simulate(context, body, garments, options, progress);
    if (result) result->clip = options.motion->clip;
    return result;
  }
  const BodyMotion closed = closed_loop(context, *options.motion, body.skin.input.skin.positions);
  DrapeOptions with = options;
  with.motion = &closed;
  auto result = simulate(context, body, garments, with, progress);
  if (result) result->clip = rig::repeat(closed.clip, options.frames * options.dt_s);
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
