#include "costs.hpp"

#include <algorithm>

#include <bodice/tryon/garment_reach.hpp>
#include <bodice/tryon/wearing.hpp>

#include <bench_support/median.hpp>
#include <bench_support/or_exit.hpp>
#include <bench_support/stopwatch.hpp>

#include "posed_proxy.hpp"
#include "truth.hpp"

namespace bench {
namespace {

using namespace bodice;

constexpr int kTurns = 7;

template <class Work>
double timed_ms(const Work& work) {
  const Stopwatch watch;
  work();
  return watch.cpu_ms();
}

Cloud cloud_of(const geometry::TriMesh& skin, std::size_t particles) {
  return coherent(near_skin(skin, particles, kNear_m, 5));
}

/// A skirt that hangs on the body at rest and goes with the skin nearest to it.
class CarriedSkirt {
 public:
  explicit CarriedSkirt(const tryon::SegmentedSkin& body)
      : body_(body),
        at_rest_(or_exit(tryon::make_garment({}, body)).mesh.positions),
        now_(at_rest_),
        reach_(at_rest_) {
    for (const geometry::Vec3& p : at_rest_)
      nearest_.push_back(body.input.skin.triangles[body.distance->closest_point(p).triangle][0]);
  }

  /// What it can reach, as in a frame of a drape.
  std::span<const geometry::Box> reach(const geometry::TriMesh& posed) {
    for (std::size_t v = 0; v < now_.size(); ++v)
      now_[v] = at_rest_[v] + posed.positions[nearest_[v]] - body_.input.skin.positions[nearest_[v]];
    reach_.boxes(now_);
    return reach_.boxes(now_);  // the frames measured lie apart in time: it has not come from the one before
  }

 private:
  const tryon::SegmentedSkin& body_;
  std::vector<geometry::Vec3> at_rest_, now_;
  std::vector<geometry::Index> nearest_;
  tryon::GarmentReach reach_;
};

/// Time of queries on one collider over those on another, by turns.
double ratio(const collision::Collider& posed, const Cloud& near_posed, const collision::Collider& rest,
             const Cloud& near_rest, const collision::QueryOptions& options) {
  Cloud a = local(near_posed, posed), b = local(near_rest, rest);
  std::vector<collision::Contact> contacts(std::max(a.size(), b.size()));
  std::vector<double> ratios;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double posed_ms = timed_ms([&] { posed.query({}, a.particles(), contacts, options); });
    const double rest_ms = timed_ms([&] { rest.query({}, b.particles(), contacts, options); });
    ratios.push_back(posed_ms / rest_ms);
  }
  return median(ratios);
}

}  // namespace

Frames frames_of(const tryon::SegmentedSkin& body, const tryon::BodyMotion& motion, int count) {
  Frames frames;
  const rig::Skeleton& skeleton = motion.rig.skeleton;
  for (int i = 0; i < count; ++i) {
    const double time_s = motion.clip.duration_s * i / std::max(1, count - 1);
    std::vector<rig::Affine> world(skeleton.joints.size()), skinning(world.size());
    rig::joint_matrices(skeleton, motion.clip, time_s, world);
    rig::skinning_matrices(skeleton, world, skinning);
    geometry::TriMesh skin = body.input.skin;
    skin.positions = pose_by_definition(motion.rig, body.input.skin.positions, world);
    frames.time_s.push_back(time_s);
    frames.world.push_back(std::move(world));
    frames.skinning.push_back(std::move(skinning));
    frames.skin.push_back(std::move(skin));
  }
  return frames;
}

PeerCost cost_of(MovingPeer& peer, const Frames& frames, const tryon::SegmentedSkin& body,
                 std::size_t particles, std::size_t query_frames) {
  std::vector<double> pose_ms, query_ns, skin_ms;
  std::vector<geometry::Vec3> posed = body.input.skin.positions;
  std::vector<float> distance_m(particles);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    skin_ms.push_back(timed_ms(
        [&] { rig::skin_linear(body.input.skin.positions, body.rig->weights, frames.skinning[i], posed); }));
    pose_ms.push_back(timed_ms([&] { peer.pose(frames.at(i)); }));
    if (i * query_frames / frames.size() == (i + 1) * query_frames / frames.size()) continue;
    const Cloud cloud = cloud_of(frames.skin[i], particles);
    for (int turn = 0; turn < 3; ++turn)
      query_ns.push_back(timed_ms([&] { peer.query(cloud, distance_m); }) * 1e6 /
                         static_cast<double>(particles));
  }
  return {median(pose_ms) + (peer.needs_skin() ? median(skin_ms) : 0.0), median(query_ns)};
}

ProxyCost proxy_cost(const tryon::PreparedBody& body, const Frames& frames, std::size_t particles) {
  const collision::Collider rest(body.fit.proxy);
  const Cloud near_rest = cloud_of(body.skin.input.skin, particles);
  PosedProxy proxy(body, false);
  CarriedSkirt worn(body.skin);
  const collision::QueryOptions exact, first{.accuracy = collision::Accuracy::kFirstOrder};
  std::vector<double> ellipsoids, tables, skirt, collider, exact_ratio, first_ratio;
  proxy.collider().pose(proxy.poser().posed(), 0.0);
  const double bind_ratio = ratio(proxy.collider(), near_rest, rest, near_rest, exact);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const MovingFrame frame = frames.at(i);
    const binding::PoseOptions reach{.within = worn.reach(frames.skin[i])};
    // A pose that follows one without tables writes all of them back, so that turns do not mix the kinds.
    for (int turn = 0; turn < 3; ++turn)
      ellipsoids.push_back(timed_ms([&] { proxy.pose_alone(frame, {.tables = false}); }));
    for (int turn = 0; turn < 3; ++turn) skirt.push_back(timed_ms([&] { proxy.pose_alone(frame, reach); }));
    for (int turn = 0; turn < 3; ++turn) tables.push_back(timed_ms([&] { proxy.pose_alone(frame, {}); }));
    collider.push_back(timed_ms([&] { proxy.collider().pose(proxy.poser().posed(), 0.0); }));
    if (i % 3 != 1) continue;
    const Cloud near_posed = cloud_of(frames.skin[i], particles);
    exact_ratio.push_back(ratio(proxy.collider(), near_posed, rest, near_rest, exact));
    first_ratio.push_back(ratio(proxy.collider(), near_posed, rest, near_rest, first));
  }
  return {median(ellipsoids),  median(tables),      median(skirt), median(collider),
          median(exact_ratio), median(first_ratio), bind_ratio};
}

}  // namespace bench
