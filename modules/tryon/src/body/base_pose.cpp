#include <bodice/tryon/base_pose.hpp>

#include <algorithm>
#include <utility>

#include <bodice/binding/poser.hpp>
#include <bodice/binding/table_warp.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/fitting/refit.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

/// The tables of a pose, as the source from which a refit starts.
class WarpedTables final : public fitting::PosedTables {
 public:
  explicit WarpedTables(const binding::TableWarp& warp) : warp_(warp) {}

  proxy::TableReading read(std::uint32_t ellipsoid, const geometry::Vec3& direction) const override {
    return warp_.read(ellipsoid, direction);
  }
  bool is_free(std::uint32_t ellipsoid) const override { return warp_.follows(ellipsoid); }

 private:
  const binding::TableWarp& warp_;
};

constexpr double kStep_s = 1.0 / 30.0;
constexpr std::size_t kMostPrepared = 64;

engine::Error no_rig() {
  return {engine::ErrorCode::kInvalidArgument, "Base pose: the skin has no rig.",
          "Read a body that has one, or give it one with tryon::give_rig()."};
}

}  // namespace

engine::Result<std::shared_ptr<const proxy::BasePose>> make_base_pose(const engine::Context& context,
                                                                      const proxy::BodyProxy& bound,
                                                                      const SegmentedSkin& skin,
                                                                      std::span<const rig::Affine> world,
                                                                      std::string name) {
  if (!skin.rig) return no_rig();
  auto warp = binding::TableWarp::make(context, bound, world);
  if (!warp) return std::move(warp).error();
  std::vector<rig::Affine> skinning(world.size());
  rig::skinning_matrices(skin.rig->skeleton, world, skinning);
  geometry::TriMesh posed = skin.input.skin;
  rig::skin_linear(context, skin.input.skin.positions, skin.rig->weights, skinning, posed.positions);
  const geometry::MeshDistance distance(context, *skin.distance, posed);
  const fitting::LabeledSkin labeled{posed, skin.anatomy.part, bound.stature_m() * warp->scale(),
                                     bound.frame(), &distance};
  auto tables =
      fitting::refit_tables(context, labeled, {bound, warp->shapes(), WarpedTables(*warp), warp->scale()});
  if (!tables) return std::move(tables).error();
  return std::make_shared<const proxy::BasePose>(proxy::BasePose{
      std::move(name), {world.begin(), world.end()}, std::move(tables->relief), std::move(tables->texels)});
}

engine::Result<proxy::BasePoses> make_base_poses(const engine::Context& context,
                                                 const proxy::BodyProxy& bound, const SegmentedSkin& skin,
                                                 const BodyMotion& motion, double until_s,
                                                 const Progress& progress) {
  auto poser = binding::Poser::make(bound);
  if (!poser) return std::move(poser).error();
  std::vector<rig::Affine> world(motion.rig.skeleton.joints.size());
  proxy::BasePoses bases;
  const double end_s = std::min(until_s, motion.clip.duration_s);
  for (int step = 0; step * kStep_s <= end_s && bases.size() < kMostPrepared; ++step) {
    context.cancel.check();
    const double time_s = step * kStep_s;
    if (progress && end_s > 0.0) progress("prepare", time_s / end_s);
    rig::joint_matrices(motion.rig.skeleton, motion.clip, time_s, world);
    if (poser->departure_rad(world) < kPreparedTurn_rad) continue;
    auto base = make_base_pose(context, bound, skin, world, engine::message(motion.clip.name, " ", time_s));
    if (!base) return std::move(base).error();
    if (auto kept = poser->keep_base(*base); !kept) return std::move(kept).error();
    bases.push_back(std::move(base).value());
  }
  return bases;
}

}  // namespace bodice::tryon
