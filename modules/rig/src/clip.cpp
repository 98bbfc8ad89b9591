#include <bodice/rig/clip.hpp>

#include <algorithm>
#include <cmath>

#include "key_values.hpp"

namespace bodice::inline v0_1::rig {

namespace {

void move(const Track& track, double time, LocalTransform& local) {
  if (!track.translation.empty()) local.translation = value_at(track.translation, time);
  if (!track.rotation.empty()) local.rotation = value_at(track.rotation, time).normalized();
  if (!track.scale.empty()) local.scale = value_at(track.scale, time);
}

/// Calls visit(joint, local transform) for each joint in order.
template <class Visit>
void for_each_local(const Skeleton& skeleton, const Clip& clip, double time, Visit&& visit) {
  auto track = clip.tracks.begin();
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    LocalTransform local = skeleton.joints[j].local;
    while (track != clip.tracks.end() && track->joint < j) ++track;
    if (track != clip.tracks.end() && track->joint == j) move(*track, time, local);
    visit(j, local);
  }
}

Affine on_parent(const Skeleton& skeleton, std::size_t j, const LocalTransform& local,
                 std::span<const Affine> world) {
  const std::int32_t parent = skeleton.joints[j].parent;
  return parent < 0 ? to_affine(local) : compose(world[static_cast<std::size_t>(parent)], to_affine(local));
}

}  // namespace

double time_in_clip(const Clip& clip, double time_s, Playback playback) {
  if (std::isnan(time_s) || !(clip.duration_s > 0.0)) return 0.0;
  if (playback == Playback::kClamp || std::isinf(time_s)) return std::clamp(time_s, 0.0, clip.duration_s);
  const double rest = std::fmod(time_s, clip.duration_s);
  return rest < 0.0 ? rest + clip.duration_s : rest;
}

void sample(const Skeleton& skeleton, const Clip& clip, double time_s, std::span<LocalTransform> local,
            Playback playback) {
  for_each_local(skeleton, clip, time_in_clip(clip, time_s, playback),
                 [&](std::size_t j, const LocalTransform& value) { local[j] = value; });
}

void joint_matrices(const Skeleton& skeleton, const Clip& clip, double time_s, std::span<Affine> world,
                    Playback playback) {
  for_each_local(
      skeleton, clip, time_in_clip(clip, time_s, playback),
      [&](std::size_t j, const LocalTransform& value) { world[j] = on_parent(skeleton, j, value, world); });
}

void world_matrices(const Skeleton& skeleton, std::span<const LocalTransform> local,
                    std::span<Affine> world) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) world[j] = on_parent(skeleton, j, local[j], world);
}

}  // namespace bodice::rig
