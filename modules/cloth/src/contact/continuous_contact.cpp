#include "contact/continuous_contact.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

namespace bodice::cloth {
namespace {

Point point(const Vec3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), 0.0f};
}

// Some particles elsewhere.
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

// Velocities are known by where the material ends. So the first look tells how far about the body comes, the
// second one sees each particle against the body as both were when the frame began.
void carry_patch(const collision::Collider& body, double frame_s, std::size_t begin, std::size_t end,
                 const Particles& p, Carry& carry) {
  collision::Contact nearest[kPatch];
  Moved places;
  for (std::size_t i = begin; i < end; ++i) places.put(i - begin, p.x[i], p.y[i], p.z[i], splat(0.0f));
  places.query(body, end - begin, nearest);
  for (std::size_t k = 0; k < end - begin; ++k) {
    const Vec3 by = frame_s * body.surface_velocity(nearest[k].ellipsoid, places.at(k));
    places.put(k, places.x[k], places.y[k], places.z[k], load(point(by)));
  }
  places.query(body, end - begin, nearest);
  for (std::size_t i = begin; i < end; ++i) {
    const collision::Contact& at = nearest[i - begin];
    const Vec3 by = frame_s * body.surface_velocity(at.ellipsoid, places.at(i - begin));
    const Vec3 normal = Eigen::Map<const Eigen::Vector3f>(at.normal).cast<double>();
    carry.by[i] = point(by);
    carry.ahead[i] = point(by.dot(normal) * normal);
  }
}

// The way of each particle against the body, in a substep, begins at `safe`; returns the longest.
float find_ways(const Carry& carry, const FrameShare& substep, std::size_t begin, std::size_t end,
                const Particles& p, Moved& safe, Moved& now) {
  Float4 longest2 = splat(0.0f);
  for (std::size_t i = begin; i < end; ++i) {
    const Float4 ahead = load(carry.ahead[i]);
    const Float4 from = (1.0f - substep.begin) * ahead, to = (1.0f - substep.end) * ahead;
    // The collider takes safe positions along as the whole frame does: they go in as they would be before it.
    safe.put(i - begin, p.old_x[i], p.old_y[i], p.old_z[i], from - load(carry.by[i]));
    now.put(i - begin, p.x[i], p.y[i], p.z[i], to);
    const Float4 way =
        Float4{p.x[i] - p.old_x[i], p.y[i] - p.old_y[i], p.z[i] - p.old_z[i], 0.0f} + to - from;
    longest2 = max(longest2, splat(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]));
  }
  return std::sqrt(longest2[0]);
}

}  // namespace

// The velocity is affine over each ellipsoid: still at four places that span space, still everywhere.
bool moves(const collision::Collider& body) {
  const Vec3 places[] = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (std::uint32_t k = 0; k < body.size(); ++k)
    for (const Vec3& place : places)
      if (body.surface_velocity(k, place) != Vec3::Zero()) return true;
  return false;
}

void begin_carry(const engine::Context& context, const collision::Collider* moving_body, double frame_s,
                 const Particles& p, Carry& carry) {
  const bool moved = carry.moving;
  carry.moving = moving_body != nullptr;
  if (!carry.moving) {
    if (moved) std::ranges::fill(carry.by, Point{});
    return;
  }
  engine::parallel_for(context, p.count(), kPatch, [&](std::size_t begin, std::size_t end) {
    carry_patch(*moving_body, frame_s, begin, end, p, carry);
  });
}

// Following a particle along its way costs much more than pushing it out where it is, and finds the same side
// unless it came through.
collision::ContactReport meet_carried(const engine::Context& context, const collision::Collider& body,
                                      const collision::ResolveOptions& how, const Carry& carry,
                                      const FrameShare& substep, std::size_t begin, std::size_t end,
                                      Particles& p) {
  Moved safe, before;
  const float way_m = find_ways(carry, substep, begin, end, p, safe, before);
  Moved after = before;
  collision::Particles view{.count = end - begin, .x = after.x, .y = after.y, .z = after.z};
  collision::ResolveOptions options = how;
  if (way_m > carry.followed_m)
    view.safe_x = safe.x, view.safe_y = safe.y, view.safe_z = safe.z;
  else
    options.max_push_m += way_m;
  const collision::ContactReport report = body.resolve(context, view, options);
  for (std::size_t i = begin; i < end; ++i) {  // who was left alone stays, to the bit
    p.x[i] += after.x[i - begin] - before.x[i - begin];
    p.y[i] += after.y[i - begin] - before.y[i - begin];
    p.z[i] += after.z[i - begin] - before.z[i - begin];
  }
  return report;
}

}  // namespace bodice::cloth
