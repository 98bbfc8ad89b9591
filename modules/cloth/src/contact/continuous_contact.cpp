#include "contact/continuous_contact.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

namespace bodice::cloth {
namespace {

Point point(const Vec3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), 0.0f};
}

// Displaced copies of the particles of a patch.
struct Moved {
  float x[kPatch] = {}, y[kPatch] = {}, z[kPatch] = {};

  void put(std::size_t k, float px, float py, float pz, Float4 by) {
    x[k] = px + by[0], y[k] = py + by[1], z[k] = pz + by[2];
  }
  Vec3 at(std::size_t k) const {
    return {static_cast<double>(x[k]), static_cast<double>(y[k]), static_cast<double>(z[k])};
  }
  void query(const collision::Collider& body, std::size_t count, collision::Contact* contacts) {
    const engine::Context alone{.executor = &engine::inline_executor()};
    body.query(alone, {.count = count, .x = x, .y = y, .z = z}, {contacts, count});
  }
};

// Finds the motion of the nearest material for each particle. Surface velocities belong to positions at the
// end of the frame. So a first query gives an approximate displacement, and a second one takes each particle
// relative to the body as both were when the frame began.
void find_motion(const collision::Collider& body, double frame_s, std::size_t begin, std::size_t end,
                 const Particles& p, BodyMotion& motion, std::span<collision::Contact> kept) {
  collision::Contact nearest[kPatch];
  Moved points;
  for (std::size_t i = begin; i < end; ++i) points.put(i - begin, p.x[i], p.y[i], p.z[i], splat(0.0f));
  points.query(body, end - begin, nearest);
  for (std::size_t k = 0; k < end - begin; ++k) {
    const Vec3 by = frame_s * body.surface_velocity(nearest[k].ellipsoid, points.at(k));
    points.put(k, points.x[k], points.y[k], points.z[k], load(point(by)));
  }
  points.query(body, end - begin, nearest);
  if (!kept.empty()) std::copy_n(nearest, end - begin, &kept[begin]);
  for (std::size_t i = begin; i < end; ++i) {
    const collision::Contact& at = nearest[i - begin];
    const Vec3 by = frame_s * body.surface_velocity(at.ellipsoid, points.at(i - begin));
    const Vec3 normal = Eigen::Map<const Eigen::Vector3f>(at.normal).cast<double>();
    motion.by[i] = point(by);
    motion.ahead[i] = point(by.dot(normal) * normal);
  }
}

// Finds the path of each particle relative to the body in a substep, from `safe` to `now`; returns the
// longest length.
float find_paths(const BodyMotion& motion, const FrameShare& substep, std::size_t begin, std::size_t end,
                 const Particles& p, Moved& safe, Moved& now) {
  Float4 longest2 = splat(0.0f);
  for (std::size_t i = begin; i < end; ++i) {
    const Float4 ahead = load(motion.ahead[i]);
    const Float4 from = (1.0f - substep.begin) * ahead, to = (1.0f - substep.end) * ahead;
    // The collider moves safe positions with the whole frame's motion, so that they are given as before the
    // frame.
    safe.put(i - begin, p.old_x[i], p.old_y[i], p.old_z[i], from - load(motion.by[i]));
    now.put(i - begin, p.x[i], p.y[i], p.z[i], to);
    const Float4 path =
        Float4{p.x[i] - p.old_x[i], p.y[i] - p.old_y[i], p.z[i] - p.old_z[i], 0.0f} + to - from;
    longest2 = max(longest2, splat(path[0] * path[0] + path[1] * path[1] + path[2] * path[2]));
  }
  return std::sqrt(longest2[0]);
}

}  // namespace

// The velocity of an ellipsoid is an affine function: if it is zero at four points that span space, it is
// zero everywhere.
bool is_moving(const collision::Collider& body) {
  const Vec3 points[] = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (std::uint32_t k = 0; k < body.size(); ++k)
    for (const Vec3& at : points)
      if (body.surface_velocity(k, at) != Vec3::Zero()) return true;
  return false;
}

void begin_motion_frame(const engine::Context& context, const collision::Collider* moving_body,
                        double frame_s, const Particles& p, BodyMotion& motion,
                        std::span<collision::Contact> nearest) {
  const bool moved = motion.moving;
  motion.moving = moving_body != nullptr;
  if (!motion.moving) {
    if (moved) std::ranges::fill(motion.by, Point{}), std::ranges::fill(motion.ahead, Point{});
    return;
  }
  engine::parallel_for(context, p.count(), kPatch, [&](std::size_t begin, std::size_t end) {
    find_motion(*moving_body, frame_s, begin, end, p, motion, nearest);
  });
}

// Continuous collision costs much more than a push from the current position, and gives the same side unless
// the particle passed through the body. So it is used for long paths only.
collision::ContactReport resolve_moving(const engine::Context& context, const collision::Collider& body,
                                        const collision::ResolveOptions& how, const BodyMotion& motion,
                                        const FrameShare& substep, std::size_t begin, std::size_t end,
                                        Particles& p) {
  Moved safe, before;
  const float path_m = find_paths(motion, substep, begin, end, p, safe, before);
  Moved after = before;
  collision::Particles view{.count = end - begin, .x = after.x, .y = after.y, .z = after.z};
  collision::ResolveOptions options = how;
  if (path_m > motion.ccd_threshold_m)
    view.safe_x = safe.x, view.safe_y = safe.y, view.safe_z = safe.z;
  else
    options.max_push_m += path_m;
  const collision::ContactReport report = body.resolve(context, view, options);
  for (std::size_t i = begin; i < end; ++i) {  // a particle without a push keeps its exact position
    p.x[i] += after.x[i - begin] - before.x[i - begin];
    p.y[i] += after.y[i - begin] - before.y[i - begin];
    p.z[i] += after.z[i - begin] - before.z[i - begin];
  }
  return report;
}

}  // namespace bodice::cloth
