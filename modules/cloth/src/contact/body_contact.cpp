// Friction acts on positions: the tangential displacement of a touching particle in a substep is reduced as
// far as the friction cone allows. A garment at rest would otherwise creep by gravity's velocity in each
// substep.
// Based on: Matthias Mueller, Miles Macklin, Nuttapong Chentanez, Stefan Jeschke, Tae-Yong Kim. Detailed
// Rigid Body Simulation with Extended Position Based Dynamics. 2020. - section 3.5 (static friction on
// positions, zero restitution)
#include "contact/body_contact.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// A push of less than this share of the most that a substep allows ends on the surface.
constexpr float kReachedSurface = 0.9f;

collision::Particles view(Particles& p, std::size_t begin, std::size_t end, bool with_velocities) {
  collision::Particles v;
  v.count = end - begin;
  v.x = &p.x[begin], v.y = &p.y[begin], v.z = &p.z[begin];
  if (with_velocities) v.vx = &p.vx[begin], v.vy = &p.vy[begin], v.vz = &p.vz[begin];
  v.safe_x = &p.old_x[begin], v.safe_y = &p.old_y[begin], v.safe_z = &p.old_z[begin];
  return v;
}

void velocities_from_positions(Particles& p, std::size_t begin, std::size_t end, float inverse_h) {
  for (std::size_t i = begin; i < end; ++i) p.vx[i] = (p.x[i] - p.old_x[i]) * inverse_h;
  for (std::size_t i = begin; i < end; ++i) p.vy[i] = (p.y[i] - p.old_y[i]) * inverse_h;
  for (std::size_t i = begin; i < end; ++i) p.vz[i] = (p.z[i] - p.old_z[i]) * inverse_h;
}

// How the body's material moves in a substep at a particle that it pushes.
struct MaterialMotion {
  Float4 displacement;    // the displacement of that material, meters
  float along_pushes_m2;  // the sum over the particle's pushes of length times the material's displacement
                          // along it, square meters
  Float4 normal;          // the normal of the surface when the substep ends; zero if the body stands still
};

// The push of a particle by the body: its direction and its length, meters.
struct Push {
  Float4 n;
  float depth;
};

Push push_of(const Particles& p, std::size_t i) {
  const Point& before = p.point[i];
  const Float4 push = {p.x[i] - before.x, p.y[i] - before.y, p.z[i] - before.z, 0.0f};
  const float depth = std::sqrt(dot(push, push));
  return {push / depth, depth};
}

// The surface's normal as a push shows it. A particle that is pushed as far as a substep allows is still
// inside, where the direction of the push shows no support: its normal is zero.
Float4 surface_normal(const Push& push, float max_push_m) {
  return push.depth < kReachedSurface * max_push_m ? push.n : splat(0.0f);
}

// Applies friction to a pushed particle and sets its velocity. The push has the length `depth` along n.
// Friction undoes up to mu * depth of the particle's displacement along the surface, relative to the body's
// material. It moves no particle into the surface, although a face may push its corners along other normals
// than theirs. Along n the velocity becomes that of the material that pushed, which may differ from the
// material at the particle.
void friction_and_velocity(Particles& p, std::size_t i, const MaterialMotion& body, float mu,
                           float inverse_h) {
  const auto [n, depth] = push_of(p, i);
  const Float4 path = {p.x[i] - p.old_x[i], p.y[i] - p.old_y[i], p.z[i] - p.old_z[i], 0.0f};
  // Where pushes nearly cancel, this quotient is arbitrary. It is therefore bounded by the displacement of
  // the material.
  const float most = std::sqrt(dot(body.displacement, body.displacement));
  const float along_n = dot(path, n) - std::clamp(body.along_pushes_m2 / depth, -most, most);
  const Float4 slip = path - body.displacement - along_n * n;
  const float length = std::sqrt(dot(slip, slip));
  const float kept = length > mu * depth ? 1.0f - mu * depth / length : 0.0f;
  Float4 held = (1.0f - kept) * slip;
  held -= std::max(0.0f, dot(held, body.normal)) * body.normal;
  p.x[i] -= held[0], p.y[i] -= held[1], p.z[i] -= held[2];
  const Float4 velocity = inverse_h * (kept * slip + body.displacement);
  p.vx[i] = velocity[0], p.vy[i] = velocity[1], p.vz[i] = velocity[2];
}

bool is_paper(const BodyContact& contact) {
  return contact.how.response == collision::Response::kPaper;
}

// Undoes a push of a pin, because the host sets its position. The velocity is undone as well, or the push
// would repeat in every remaining substep of the frame.
void restore_pin(Particles& p, std::size_t i, float inverse_h) {
  const Point& before = p.point[i];
  p.x[i] = before.x, p.y[i] = before.y, p.z[i] = before.z;
  p.vx[i] = (p.x[i] - p.old_x[i]) * inverse_h;
  p.vy[i] = (p.y[i] - p.old_y[i]) * inverse_h;
  p.vz[i] = (p.z[i] - p.old_z[i]) * inverse_h;
}

// Completes the contact of a particle after its push: a pin that does not yield returns, another particle
// gets friction and a velocity.
void respond(Particles& p, ContactState& s, std::size_t i, const BodyContact& contact) {
  const Point& before = p.point[i];
  const bool stays_pinned = p.inverse_mass[i] == 0.0f && !(before.weight > 0.0f);
  if (stays_pinned) restore_pin(p, i, contact.substep.inverse_per_s());
  s.touching[i] = p.x[i] != before.x || p.y[i] != before.y || p.z[i] != before.z;
  if (!s.touching[i]) return;
  store(s.normal[i], surface_normal(push_of(p, i), contact.how.max_push_m));
  if (is_paper(contact)) return;
  const BodyMotion& m = s.motion;
  const auto [begin, end] = contact.substep.share;
  const float share = end - begin;
  const Float4 normal = turned(load(m.normal[i]), (end - 1.0f) * load(m.rotation[i]));
  friction_and_velocity(p, i, {share * load(m.displacement[i]), share * m.along_pushes_m2[i], normal},
                        m.moving ? s.friction * s.friction_share[i] : s.friction,
                        contact.substep.inverse_per_s());
}

// Resolves the contacts of the particles of a patch. Runs of consecutive clusters that may touch the body go
// to the collider together; all others are skipped.
void resolve_patch(const engine::Context& alone, const BodyContact& contact, std::size_t begin,
                   std::size_t end, ContactState& s, Particles& p) {
  ContactPatch& patch = s.patch[begin / kPatch];
  std::size_t first = begin;  // where the current run begins
  auto resolve_run = [&](std::size_t last) {
    if (first == last) return;
    const std::int64_t begin_ns = alone.clock->now_ns();
    patch.report.add(
        s.motion.moving && !is_paper(contact)
            ? resolve_moving(alone, contact, s.motion, first, last, p)
            : contact.body->resolve(alone, view(p, first, last, is_paper(contact)), contact.how));
    patch.spent_ns += alone.clock->now_ns() - begin_ns;
  };
  for (std::size_t from = begin; from < end; from += kCluster) {
    const std::size_t to = std::min(from + kCluster, end);
    if (may_touch(p, from, to, s.clearance)) continue;
    resolve_run(from);
    first = to;
  }
  resolve_run(end);
}

// Copies four points to the positions; returns false and copies none if one is not finite.
bool copy_four_points(Particles& p, std::size_t i) {
  const Point* const point = &p.point[i];
  Float4 x = load(point[0]), y = load(point[1]), z = load(point[2]), weight = load(point[3]);
  transpose(x, y, z, weight);
  const Float4 sum = x + y + z, none = sum - sum;
  if (lane_bits(none == splat(0.0f)) != 0xFu) return false;
  store(&p.x[i], x), store(&p.y[i], y), store(&p.z[i], z);
  return true;
}

// Copies points to the positions. A particle that is not finite returns to its position at the start of the
// substep.
std::uint32_t copy_from_points(Particles& p, std::size_t begin, std::size_t end) {
  std::uint32_t limits = 0;
  for (std::size_t i = begin; i < end; ++i) {
    while (i + 4 <= end && copy_four_points(p, i)) i += 4;
    if (i == end) break;
    Point& at = p.point[i];
    if (!std::isfinite(at.x + at.y + at.z)) {
      at.x = p.old_x[i], at.y = p.old_y[i], at.z = p.old_z[i];
      limits = kParticlesReset;
    }
    p.x[i] = at.x, p.y[i] = at.y, p.z[i] = at.z;
  }
  return limits;
}

}  // namespace

ContactState make_contacts(std::size_t particles, double friction, FaceContact faces) {
  ContactState s;
  s.friction = static_cast<float>(friction);
  s.friction_share.assign(particles, 1.0f);
  s.touching.assign(particles, 0);
  s.normal.assign(particles, {});
  s.clearance = make_clearance_cache(particles);
  s.motion = make_motion(particles, friction);
  s.patch.resize(engine::block_count(particles, kPatch));
  s.faces = std::move(faces);
  return s;
}

void begin_contact_frame(const engine::Context& context, const ContactFrame& given,
                         const SolverOptions& options, Particles& particles, ContactState& s) {
  const std::int64_t begin_ns = context.clock->now_ns();
  ContactFrame frame = given;
  // The paper's response has distances of its own and uses surface velocities by itself.
  if (options.response == collision::Response::kPaper) frame.body = nullptr;
  // Memory is allocated before the body moves.
  if (frame.body != nullptr) s.motion.ellipsoids.resize(frame.body->size());
  begin_motion_frame(context, frame, particles, s.motion, s.faces.nearest);
  begin_clearance_frame(context, frame, s.touching, particles, s.clearance);
  s.faces.on = false;
  s.proof = {};
  if (frame.body != nullptr && options.face_contact) {
    if (!s.motion.moving) query_particles(context, *frame.body, s.faces, particles);
    begin_face_frame(
        context, frame, options.environment,
        {s.motion.shift, s.motion.rotation, s.motion.along_pushes_m2, s.motion.follow, s.motion.moving},
        particles, s.faces);
  }
  s.patch.assign(s.patch.size(), {});
  s.patch.front().spent_ns = context.clock->now_ns() - begin_ns;
}

std::uint32_t resolve_body_contacts(const engine::Context& context, const collision::Collider* collider,
                                    const SolverOptions& options, const Substep& substep, ContactState& s,
                                    Particles& p) {
  const bool paper = options.response == collision::Response::kPaper;
  const BodyContact contact = {collider,
                               {.response = options.response,
                                .thickness_m = static_cast<float>(options.thickness_m),
                                .friction = paper ? s.friction : 0.0f,
                                .max_push_m = kFromBody_m_s * substep.length_s},
                               substep};
  const float inverse_h = substep.inverse_per_s();
  engine::Context alone = context;  // one worker resolves a whole patch
  alone.executor = &engine::inline_executor();
  const FaceSubstep faces = {substep.length_s, substep.share.end - substep.share.begin,
                             1.0f - substep.share.end};
  std::atomic<std::uint32_t> limits{0};
  engine::parallel_for(context, p.count(), kPatch, [&](std::size_t begin, std::size_t end) {
    if (const std::uint32_t reset = copy_from_points(p, begin, end))
      limits.fetch_or(reset, std::memory_order_relaxed);
    if (paper || collider == nullptr) velocities_from_positions(p, begin, end, inverse_h);
    if (s.motion.moving)
      std::fill(&s.motion.along_pushes_m2[begin], &s.motion.along_pushes_m2[begin] + (end - begin), 0.0f);
    if (s.faces.on) begin_face_substep(faces, begin, end, p, s.faces);
  });
  if (collider == nullptr) return limits.load();
  if (s.faces.on) {
    const std::int64_t begin_ns = context.clock->now_ns();
    push_faces_out(context, *collider, faces, p, s.faces);
    s.patch.front().spent_ns += context.clock->now_ns() - begin_ns;
  }
  // Particles come last, because their paths show on which side of the body they belong.
  engine::parallel_for(context, p.count(), kPatch, [&](std::size_t begin, std::size_t end) {
    if (s.faces.on) end_face_substep(begin, end, s.faces, p);
    resolve_patch(alone, contact, begin, end, s, p);
    if (!paper) velocities_from_positions(p, begin, end, inverse_h);
    for (std::size_t i = begin; i < end; ++i) respond(p, s, i, contact);
  });
  return limits.load();
}

void end_contact_frame(const engine::Context& context, const collision::Collider& collider,
                       const SolverOptions& options, ContactState& s, Particles& p) {
  if (!options.certify_m || s.faces.elements.all.empty()) return;
  const std::int64_t begin_ns = context.clock->now_ns();
  s.proof = prove_faces(context, collider, static_cast<float>(*options.certify_m), s.faces, p, s.certificate);
  s.patch.front().spent_ns += context.clock->now_ns() - begin_ns;
}

void report_contacts(const ContactState& s, FrameReport& report) {
  if (s.faces.on) report.faces = report_faces(s.faces);
  report.faces.proof = s.proof;
  for (const ContactPatch& patch : s.patch) {
    report.contacts.add(patch.report);
    report.collision_us += 1e-3 * static_cast<double>(patch.spent_ns);
  }
}

}  // namespace bodice::cloth
