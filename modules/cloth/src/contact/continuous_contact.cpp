#include "contact/continuous_contact.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// With at least this coefficient of friction cloth follows the surface wholly, with less by a proportional
// share.
constexpr double kFollowingFriction = 0.2;
// If the volume of an ellipsoid grows by more than the inverse of this in a frame, where its material was is
// unknown.
constexpr double kLeastGrowth = 1e-3;

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

// The motion of the material of one ellipsoid in a frame. Velocities belong to positions when the frame ends,
// where they are an affine function: displacement(end) = A end + b.
EllipsoidMotion motion_of(const collision::Collider& body, std::uint32_t ellipsoid, double frame_s) {
  const Vec3 b = frame_s * body.surface_velocity(ellipsoid, Vec3::Zero());
  Mat3 a;
  for (int column = 0; column < 3; ++column)
    a.col(column) = frame_s * body.surface_velocity(ellipsoid, Vec3::Unit(column)) - b;
  // The rotation vector is half the curl of the displacement.
  const Vec3 rotation = 0.5 * Vec3(a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1));
  // end = start + A end + b. An ellipsoid that grows from next to nothing has no such inverse.
  Mat3 from_start;
  bool invertible = false;
  (Mat3::Identity() - a).eval().computeInverseWithCheck(from_start, invertible, kLeastGrowth);
  if (!invertible) return {a, b, rotation};
  return {from_start - Mat3::Identity(), from_start * b, rotation};
}

// Finds the motion of the nearest material for each particle. The pose when the frame began is no longer
// known, but each particle's owner in it is. The owner's motion takes the particle to where a query in the
// final pose finds the same material. Without an owner, the ellipsoid nearest in the final pose is used.
// Where a limb has moved by more than its width, this ellipsoid may belong to another limb.
void find_motion(const ContactFrame& frame, std::size_t begin, std::size_t end, const Particles& p,
                 BodyMotion& motion, std::span<collision::Contact> kept) {
  const collision::Collider& body = *frame.body;
  collision::Contact nearest[kPatch];
  Moved points;
  bool all_known = true;
  for (std::size_t i = begin; i < end; ++i) {
    points.put(i - begin, p.x[i], p.y[i], p.z[i], splat(0.0f));
    all_known = all_known && motion.owner[i] != collision::kNoEllipsoid;
  }
  if (!all_known) points.query(body, end - begin, nearest);
  for (std::size_t k = 0; k < end - begin; ++k) {
    const std::uint32_t known = motion.owner[begin + k];
    const std::uint32_t owner = known != collision::kNoEllipsoid ? known : nearest[k].ellipsoid;
    const Vec3 by = motion.of(owner).displacement(points.at(k));
    points.put(k, points.x[k], points.y[k], points.z[k], load(point(by)));
  }
  points.query(body, end - begin, nearest);
  const Steepness& steepness = body.has_relief() ? kReliefSteepness : kPlainSteepness;
  const float touching_m = static_cast<float>(frame.thickness_m) + steepness.rise_m;
  const double follow = double{motion.follow};
  if (!kept.empty()) std::copy_n(nearest, end - begin, &kept[begin]);
  for (std::size_t i = begin; i < end; ++i) {
    const collision::Contact& at = nearest[i - begin];
    const Vec3 by = frame.length_s * body.surface_velocity(at.ellipsoid, points.at(i - begin));
    const Vec3 normal = Eigen::Map<const Eigen::Vector3f>(at.normal).cast<double>();
    motion.displacement[i] = point(by), motion.normal[i] = point(normal);
    motion.shift[i] = point(follow * by + (1.0 - follow) * by.dot(normal) * normal);
    motion.rotation[i] = point(follow * motion.of(at.ellipsoid).rotation);
    motion.free_ball[i] = point(points.at(i - begin));
    motion.free_ball[i].weight = (at.signed_distance - touching_m) / steepness.slope;
  }
}

// Whether particle i cannot touch the body on the path between these points, which are shifted to the pose at
// the end of the frame.
bool is_clear(const BodyMotion& motion, std::size_t i, Float4 from, Float4 to) {
  const float radius_m = motion.free_ball[i].weight;
  const Float4 at = load(motion.free_ball[i]), before = xyz(from - at), now = xyz(to - at);
  return radius_m > 0.0f && std::max(dot(before, before), dot(now, now)) < radius_m * radius_m;
}

// Particles of a patch that are resolved together.
struct Group {
  std::uint32_t particle[kPatch];
  Moved safe, now;  // where their paths begin, and where they are
  std::size_t count = 0;
  float longest_m = 0.0f;  // the longest of their paths in the substep, relative to the body

  void add(std::size_t i, float length_m) {
    particle[count++] = static_cast<std::uint32_t>(i);
    longest_m = std::max(longest_m, length_m);
  }
};

// The particles of a patch that may touch the body, divided into short and long paths in a substep, relative
// to it.
struct ByPath {
  Group short_paths, long_paths;

  ByPath(const BodyMotion& motion, const FrameShare& substep, std::size_t begin, std::size_t end,
         const Particles& p) {
    for (std::size_t i = begin; i < end; ++i) {
      const Float4 shift = load(motion.shift[i]);
      const Float4 from = (1.0f - substep.begin) * shift, to = (1.0f - substep.end) * shift;
      const Float4 old = {p.old_x[i], p.old_y[i], p.old_z[i], 0.0f}, at = {p.x[i], p.y[i], p.z[i], 0.0f};
      if (is_clear(motion, i, old + from, at + to)) continue;
      const Float4 path = at - old + to - from;
      const float length_m = std::sqrt(path[0] * path[0] + path[1] * path[1] + path[2] * path[2]);
      Group& group = length_m > motion.ccd_threshold_m ? long_paths : short_paths;
      // The collider moves safe positions with the whole frame's motion, so that they are given as before
      // the frame.
      if (&group == &long_paths)
        group.safe.put(group.count, p.old_x[i], p.old_y[i], p.old_z[i], from - load(motion.displacement[i]));
      group.now.put(group.count, p.x[i], p.y[i], p.z[i], to);
      group.add(i, length_m);
    }
  }
};

// Resolves a group with continuous collision from safe positions, or by the current positions alone.
collision::ContactReport resolve_group(const engine::Context& context, const BodyContact& contact,
                                       bool continuous, const Group& group, BodyMotion& motion,
                                       Particles& p) {
  if (group.count == 0) return {};
  Moved after = group.now;
  collision::Particles view{.count = group.count, .x = after.x, .y = after.y, .z = after.z};
  collision::ResolveOptions options = contact.how;
  if (continuous)
    view.safe_x = group.safe.x, view.safe_y = group.safe.y, view.safe_z = group.safe.z;
  else
    options.max_push_m += group.longest_m;
  const collision::ContactReport report = contact.body->resolve(context, view, options);
  for (std::size_t k = 0; k < group.count; ++k) {
    const std::size_t i = group.particle[k];
    const Float4 push = {after.x[k] - group.now.x[k], after.y[k] - group.now.y[k],
                         after.z[k] - group.now.z[k], 0.0f};
    motion.along_pushes_m2[i] += dot(push, load(motion.displacement[i]));
    const Float4 by = turned(push, (contact.substep.share.end - 1.0f) * load(motion.rotation[i]));
    p.x[i] += by[0], p.y[i] += by[1], p.z[i] += by[2];  // a particle without a push keeps its exact position
  }
  return report;
}

}  // namespace

BodyMotion make_motion(std::size_t particles, double friction) {
  BodyMotion motion;
  motion.follow = static_cast<float>(std::clamp(friction / kFollowingFriction, 0.0, 1.0));
  for (auto* vectors :
       {&motion.displacement, &motion.shift, &motion.normal, &motion.rotation, &motion.free_ball})
    vectors->resize(particles);
  motion.along_pushes_m2.resize(particles);
  motion.owner.assign(particles, collision::kNoEllipsoid);
  return motion;
}

// The velocity of an ellipsoid is an affine function: if it is zero at four points that span space, it is
// zero everywhere.
bool is_moving(const collision::Collider& body) {
  const Vec3 points[] = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (std::uint32_t k = 0; k < body.size(); ++k)
    for (const Vec3& at : points)
      if (body.surface_velocity(k, at) != Vec3::Zero()) return true;
  return false;
}

void begin_motion_frame(const engine::Context& context, const ContactFrame& frame, const Particles& p,
                        BodyMotion& motion, std::span<collision::Contact> nearest) {
  const bool moved = motion.moving;
  motion.moving = frame.moving_body() != nullptr;
  if (!motion.moving) {
    if (!moved) return;
    for (auto* vectors : {&motion.displacement, &motion.shift, &motion.normal, &motion.rotation})
      std::ranges::fill(*vectors, Point{});
    std::ranges::fill(motion.along_pushes_m2, 0.0f);
    return;
  }
  for (std::uint32_t k = 0; k < motion.ellipsoids.size(); ++k)
    motion.ellipsoids[k] = motion_of(*frame.body, k, frame.length_s);
  engine::parallel_for(context, p.count(), kPatch, [&](std::size_t begin, std::size_t end) {
    find_motion(frame, begin, end, p, motion, nearest);
  });
}

void end_motion_frame(const engine::Context& context, const collision::Collider& body, const Particles& p,
                      std::span<const collision::Contact> nearest, BodyMotion& motion) {
  if (!motion.moving) {
    for (std::size_t i = 0; i < nearest.size(); ++i) motion.owner[i] = nearest[i].ellipsoid;
    return;
  }
  engine::parallel_for(context, p.count(), kPatch, [&](std::size_t begin, std::size_t end) {
    collision::Contact contact[kPatch];
    Moved points;
    for (std::size_t i = begin; i < end; ++i) points.put(i - begin, p.x[i], p.y[i], p.z[i], splat(0.0f));
    points.query(body, end - begin, contact);
    for (std::size_t i = begin; i < end; ++i) motion.owner[i] = contact[i - begin].ellipsoid;
  });
}

void forget_owners(BodyMotion& motion) {
  std::ranges::fill(motion.owner, collision::kNoEllipsoid);
}

// Continuous collision costs much more than a push from the current position, and gives the same side unless
// the particle passed through the body. So it is used for long paths only.
collision::ContactReport resolve_moving(const engine::Context& context, const BodyContact& contact,
                                        BodyMotion& motion, std::size_t begin, std::size_t end,
                                        Particles& p) {
  const ByPath paths(motion, contact.substep.share, begin, end, p);
  collision::ContactReport report = resolve_group(context, contact, false, paths.short_paths, motion, p);
  report.add(resolve_group(context, contact, true, paths.long_paths, motion, p));
  return report;
}

}  // namespace bodice::cloth
