#include "drape/drape_frames.hpp"

#include <cmath>
#include <utility>

#include <bodice/engine/message.hpp>

#include "drape/drape_report.hpp"
#include "measure/fit_warnings.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

constexpr double kRampStep_s = 1.0 / 60.0;
constexpr double kJudgedWithin_m = 0.03, kVisibleDepth_m = 0.5e-3;

}  // namespace

engine::Result<Scene> make_scene(const Wardrobe& all, cloth::Solver& solver, const PreparedBody& body,
                                 const proxy::BodyProxy& with_props, bool moves,
                                 const proxy::BasePoses& bases) {
  auto contact_body = MovingBody::make(body.skin, with_props, moves);
  if (!contact_body) return std::move(contact_body).error();
  auto whole_body = MovingBody::make(body.skin, body.fit.proxy, moves);
  if (!whole_body) return std::move(whole_body).error();
  for (MovingBody* of : {&*contact_body, &*whole_body})
    if (auto kept = of->keep_bases(bases); !kept) return std::move(kept).error();
  return Scene{all, solver, std::move(contact_body).value(), std::move(whole_body).value()};
}

Drape::Drape(const engine::Context& context, const DrapeOptions& options, Scene& scene, Recorder& recorder,
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

void Drape::hold(double thickness_m, const rig::SkinWeights* skin_weights, const PreparedBody& body) {
  held_ = held_positions(scene_.all, scene_.contact_body.collider(), thickness_m);
  if (skin_weights)
    held_weights_ = attach_to_skin(body.skin.input.skin, *body.skin.distance, *skin_weights, held_);
  posed_ = held_;
  scene_.solver.move_pins(posed_);
}

engine::Result<void> Drape::ramp() {
  const double ramp_s = result_.report.ramp_s;
  const int steps = static_cast<int>(std::ceil(ramp_s / kRampStep_s));
  if (steps == 0) return pose(0.0, 0.0);  // without a ramp the body jumps to the first frame
  for (int step = 1; step <= steps; ++step) {
    context_.cancel.check();
    if (auto posed = pose(-ramp_s * (1.0 - static_cast<double>(step) / steps), ramp_s / steps); !posed)
      return posed;
    scene_.solver.step(context_, scene_.contact_body.collider(), ramp_s / steps);
    scene_.solver.positions(positions_);
  }
  return {};
}

engine::Result<void> Drape::run(const Progress& progress) {
  DrapeReport& report = result_.report;
  std::vector<double> frame_ms;
  scene_.solver.positions(positions_);
  record_and_measure(0, scene_.contact_body.moves()
                            ? penetration(context_, scene_.contact_body.distance(context_), positions_)
                            : Penetration{});
  for (int frame = 1; frame <= options_.frames; ++frame) {
    context_.cancel.check();
    const std::int64_t begin_ns = context_.clock->now_ns();
    if (auto posed = pose(frame * options_.dt_s, options_.dt_s); !posed) return posed;
    const cloth::FrameReport step =
        scene_.solver.step(context_, scene_.contact_body.collider(), options_.dt_s);
    frame_ms.push_back(static_cast<double>(context_.clock->now_ns() - begin_ns) * 1e-6);

    scene_.solver.positions(positions_);
    report.finite = report.finite && step.finite;
    const Penetration depth = penetration(context_, scene_.contact_body.distance(context_), positions_);
    add_frame(frame, depth, report);
    add_frame(context_, frame, positions_, options_.props, report.props);
    add_cloth(step, report);
    record_and_measure(frame, depth);
    if (progress) progress("drape", static_cast<double>(frame) / options_.frames);
  }
  summarize_times(std::move(frame_ms), report);
  return {};
}

void Drape::measure_garments(const std::vector<WornGarment>& garments, const PreparedBody& body,
                             const cloth::Fabric& fabric) {
  for (std::size_t g = 0; g < garments.size(); ++g) {
    const WornGarment& garment = garments[g];
    const std::span<const Vec3> now =
        positions().subspan(scene_.all.first_vertex[g], garment.mesh.positions.size());
    std::vector<PartEase>& ease = result_.report.garments[g].ease;
    ease = measure_ease(context_, scene_.contact_body.skin(context_), body.skin.anatomy.part,
                        scene_.contact_body.distance(context_), garment.mesh, now);
    const std::vector<PartEase> start =
        measure_ease(context_, body.skin.input.skin, body.skin.anatomy.part, *body.skin.distance,
                     garment.mesh, garment.mesh.positions);
    warn_of_fit({garment, start, ease, now, body.skin.anatomy.up, !scene_.contact_body.moves()}, fabric,
                result_.report.warnings);
  }
}

void Drape::color(const FitScale& scale, const std::vector<WornGarment>& garments,
                  std::vector<io::GarmentTrack>& tracks) {
  for (std::size_t g = 0; g < garments.size(); ++g) {
    const std::span<const Vec3> now =
        positions().subspan(scene_.all.first_vertex[g], garments[g].mesh.positions.size());
    tracks[g].colors = fit_colors(
        scale.map == FitMap::kEase ? ease_of_vertices(context_, scene_.contact_body.distance(context_), now)
                                   : strain_of_vertices(garments[g].mesh, now),
        scale);
  }
}

engine::Result<void> Drape::pose(double time_s, double dt_s) {
  if (!scene_.contact_body.moves()) return {};
  player_->joints(time_s, joints_);
  if (auto posed = scene_.contact_body.pose(context_, joints_, dt_s, {.within = reach_.boxes(positions_)});
      !posed)
    return engine::Error{posed.error().code,
                         engine::message("At second ", time_s, " of the clip '", options_.motion->clip.name,
                                         "': ", posed.error().message),
                         posed.error().remedy};
  scene_.contact_body.carry(held_, held_weights_, posed_);
  scene_.solver.move_pins(posed_);
  return {};
}

void Drape::record_and_measure(int frame, const Penetration& depth) {
  const double time_s = frame * options_.dt_s;
  if (!recorder_.record_if_kept(frame, positions_, time_s) || !scene_.contact_body.moves()) return;
  // The whole body takes the pose that the contact body had in this frame.
  static_cast<void>(scene_.whole_body.pose(context_, joints_, 0.0));
  const geometry::MeshDistance& skin = scene_.contact_body.distance(context_);
  result_.body_frames.push_back(scene_.contact_body.skin(context_).positions);
  result_.proxy_frames.push_back(scene_.contact_body.poser()->posed().shapes);
  result_.report.kept.push_back(
      {.time_s = time_s,
       .proxy_error = measure_proxy_error(context_, scene_.whole_body.collider(),
                                          scene_.contact_body.skin(context_), skin, kJudgedWithin_m),
       .penetration_max_m = depth.deepest_m,
       .inside = cloth_inside(context_, skin, positions_, scene_.all.mesh.triangles, kVisibleDepth_m)});
}

}  // namespace bodice::tryon
