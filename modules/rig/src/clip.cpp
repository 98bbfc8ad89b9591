#include <bodice/rig/clip.hpp>

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::rig {

namespace {

using Eigen::Quaterniond;

/// The keys around a time: both the same before the first key and after the last one.
struct Span {
  std::size_t before = 0, after = 0;
  double length_s = 0.0, along = 0.0;  // along: 0 at `before`, 1 at `after`
};

Span find_span(const std::vector<double>& time_s, double time) {
  const auto next = std::upper_bound(time_s.begin(), time_s.end(), time);
  if (next == time_s.begin()) return {};
  const std::size_t before = static_cast<std::size_t>(next - time_s.begin()) - 1;
  if (next == time_s.end()) return {before, before};
  const double length = *next - time_s[before];
  return {before, before + 1, length, (time - time_s[before]) / length};
}

Vec3 between(const Vec3& a, const Vec3& b, double along) {
  return a + along * (b - a);
}
Quaterniond between(const Quaterniond& a, const Quaterniond& b, double along) {
  return a.slerp(along, b);
}

/// The Hermite spline's four weights: value and tangent at its begin, value and tangent at its end.
Eigen::Vector4d hermite(double s, double length) {
  const double s2 = s * s, s3 = s2 * s;
  return {2 * s3 - 3 * s2 + 1, length * (s3 - 2 * s2 + s), 3 * s2 - 2 * s3, length * (s3 - s2)};
}

Vec3 blend(const Eigen::Vector4d& w, const Vec3& a, const Vec3& ta, const Vec3& b, const Vec3& tb) {
  return w[0] * a + w[1] * ta + w[2] * b + w[3] * tb;
}
Quaterniond blend(const Eigen::Vector4d& w, const Quaterniond& a, const Quaterniond& ta, const Quaterniond& b,
                  const Quaterniond& tb) {
  const Eigen::Vector4d sum = w[0] * a.coeffs() + w[1] * ta.coeffs() + w[2] * b.coeffs() + w[3] * tb.coeffs();
  return sum.norm() > 0.0 ? Quaterniond(Eigen::Vector4d(sum.normalized())) : a;
}

template <class T>
T value_at(const Keys<T>& keys, double time) {
  const Span span = find_span(keys.time_s, time);
  const bool cubic = keys.interpolation == Interpolation::kCubic;
  const auto key = [&](std::size_t k) -> const T& { return keys.value[cubic ? 3 * k + 1 : k]; };
  if (span.before == span.after || keys.interpolation == Interpolation::kStep) return key(span.before);
  if (!cubic) return between(key(span.before), key(span.after), span.along);
  return blend(hermite(span.along, span.length_s), key(span.before), keys.value[3 * span.before + 2],
               key(span.after), keys.value[3 * span.after]);
}

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
