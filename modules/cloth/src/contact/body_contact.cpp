// Friction on positions: within a substep the tangential displacement of a touching particle is taken back as
// far as the cone allows, so that a garment at rest does not creep by g h a substep.
// Based on: Matthias Mueller et al. Detailed Rigid Body Simulation with Extended Position Based Dynamics.
// 2020. - section 3.5 (static friction on positions, zero restitution on velocities)
#include "contact/body_contact.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::cloth {
namespace {

// How fast a particle that is deeper than its last path explains is brought out: a garment that begins two
// centimeters inside is out after a frame, and neighbors feel no jerk.
constexpr float kRecovery_m_s = 1.0f;

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

// The push out is `depth` along n. Friction may take back that much times mu of the displacement along the
// surface, against the body's material, which comes `carried` far; no velocity against it is left along n.
void friction_and_velocity(Particles& p, std::size_t i, Float4 carried, float mu, float inverse_h) {
  const Point& before = p.point[i];
  const float px = p.x[i] - before.x, py = p.y[i] - before.y, pz = p.z[i] - before.z;
  const float depth = std::sqrt(px * px + py * py + pz * pz);
  const float nx = px / depth, ny = py / depth, nz = pz / depth;
  const float dx = p.x[i] - p.old_x[i] - carried[0], dy = p.y[i] - p.old_y[i] - carried[1],
              dz = p.z[i] - p.old_z[i] - carried[2];
  const float along_n = dx * nx + dy * ny + dz * nz;
  const float tx = dx - along_n * nx, ty = dy - along_n * ny, tz = dz - along_n * nz;
  const float slip = std::sqrt(tx * tx + ty * ty + tz * tz);
  const float kept = slip > mu * depth ? 1.0f - mu * depth / slip : 0.0f;
  p.x[i] -= (1.0f - kept) * tx, p.y[i] -= (1.0f - kept) * ty, p.z[i] -= (1.0f - kept) * tz;
  p.vx[i] = (kept * tx + carried[0]) * inverse_h;
  p.vy[i] = (kept * ty + carried[1]) * inverse_h;
  p.vz[i] = (kept * tz + carried[2]) * inverse_h;
}

struct Meeting {
  const collision::Collider* collider;
  collision::ResolveOptions how;
  float friction;
  float inverse_h;
  FrameShare share;

  bool paper() const { return how.response == collision::Response::kPaper; }
};

// A pin goes where the host wants it, whatever the body says. Its velocity, too: with that of a push, it
// would go that far in every substep of the frame that is left.
void put_back(Particles& p, std::size_t i, float inverse_h) {
  const Point& before = p.point[i];
  p.x[i] = before.x, p.y[i] = before.y, p.z[i] = before.z;
  p.vx[i] = (p.x[i] - p.old_x[i]) * inverse_h;
  p.vy[i] = (p.y[i] - p.old_y[i]) * inverse_h;
  p.vz[i] = (p.z[i] - p.old_z[i]) * inverse_h;
}

void respond(Particles& p, ContactState& s, std::size_t i, const Meeting& meeting) {
  const Point& before = p.point[i];
  if (p.inverse_mass[i] == 0.0f) put_back(p, i, meeting.inverse_h);
  s.touching[i] = p.x[i] != before.x || p.y[i] != before.y || p.z[i] != before.z;
  if (!s.touching[i] || meeting.paper()) return;
  const Float4 carried = (meeting.share.end - meeting.share.begin) * load(s.carry.by[i]);
  friction_and_velocity(p, i, carried, meeting.friction, meeting.inverse_h);
}

// The collider sees the clusters that may touch, in runs as long as they come.
void meet_patch(const engine::Context& alone, const Meeting& meeting, std::size_t begin, std::size_t end,
                ContactState& s, Particles& p) {
  ContactPatch& patch = s.patch[begin / kPatch];
  std::size_t first = begin;  // of the run so far
  auto meet_run = [&](std::size_t last) {
    if (first == last) return;
    const std::int64_t begin_ns = alone.clock->now_ns();
    patch.report.add(
        s.carry.moving && !meeting.paper()
            ? meet_carried(alone, *meeting.collider, meeting.how, s.carry, meeting.share, first, last, p)
            : meeting.collider->resolve(alone, view(p, first, last, meeting.paper()), meeting.how));
    patch.spent_ns += alone.clock->now_ns() - begin_ns;
    if (!meeting.paper()) velocities_from_positions(p, first, last, meeting.inverse_h);
    for (std::size_t i = first; i < last; ++i) respond(p, s, i, meeting);
  };
  for (std::size_t from = begin; from < end; from += kCluster) {
    const std::size_t to = std::min(from + kCluster, end);
    if (may_touch(p, from, to, s.clearance)) continue;
    meet_run(from);
    if (!meeting.paper()) velocities_from_positions(p, from, to, meeting.inverse_h);
    std::fill_n(&s.touching[from], to - from, std::uint8_t{0});
    first = to;
  }
  meet_run(end);
}

// From four points to the positions, if they are finite.
bool take_four(Particles& p, std::size_t i) {
  const Point* const point = &p.point[i];
  Float4 x = load(point[0]), y = load(point[1]), z = load(point[2]), weight = load(point[3]);
  transpose(x, y, z, weight);
  const Float4 sum = x + y + z, none = sum - sum;
  if (lane_bits(none == splat(0.0f)) != 0xFu) return false;
  store(&p.x[i], x), store(&p.y[i], y), store(&p.z[i], z);
  return true;
}

// From the points to the positions. A particle that is not finite goes back to where the substep began.
std::uint32_t take_from_points(Particles& p, std::size_t begin, std::size_t end) {
  std::uint32_t limits = 0;
  for (std::size_t i = begin; i < end; ++i) {
    while (i + 4 <= end && take_four(p, i)) i += 4;
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

ContactState make_contacts(std::size_t particles) {
  ContactState s;
  s.touching.assign(particles, 0);
  s.clearance = make_clearance(particles);
  s.carry.by.resize(particles), s.carry.ahead.resize(particles);
  s.patch.resize(engine::block_count(particles, kPatch));
  return s;
}

void begin_contact_frame(const engine::Context& context, const collision::Collider* collider, bool moved,
                         const SolverOptions& options, double frame_s, double travel_m, Particles& particles,
                         ContactState& s) {
  const std::int64_t begin_ns = context.clock->now_ns();
  // The paper's response goes by its own distances and takes surface velocities by itself.
  const collision::Collider* body = options.response == collision::Response::kPaper ? nullptr : collider;
  begin_carry(context, moved ? body : nullptr, frame_s, particles, s.carry);
  begin_clearance(context, s.carry.moving ? nullptr : body, options.thickness_m, travel_m, s.touching,
                  particles, s.clearance);
  s.patch.assign(s.patch.size(), {});
  s.patch.front().spent_ns = context.clock->now_ns() - begin_ns;
}

std::uint32_t meet_body(const engine::Context& context, const collision::Collider* collider,
                        const SolverOptions& options, float friction, const Substep& substep, ContactState& s,
                        Particles& p) {
  const bool paper = options.response == collision::Response::kPaper;
  const Meeting meeting = {collider,
                           {.response = options.response,
                            .thickness_m = static_cast<float>(options.thickness_m),
                            .friction = paper ? friction : 0.0f,
                            .max_push_m = kRecovery_m_s * substep.length_s},
                           friction,
                           1.0f / substep.length_s,
                           substep.share};
  engine::Context alone = context;  // a patch is one worker's
  alone.executor = &engine::inline_executor();
  std::atomic<std::uint32_t> limits{0};
  engine::parallel_for(context, p.count(), kPatch, [&](std::size_t begin, std::size_t end) {
    if (const std::uint32_t reset = take_from_points(p, begin, end))
      limits.fetch_or(reset, std::memory_order_relaxed);
    if (paper || collider == nullptr) velocities_from_positions(p, begin, end, meeting.inverse_h);
    if (collider != nullptr) meet_patch(alone, meeting, begin, end, s, p);
  });
  return limits.load();
}

void report_contacts(const ContactState& s, FrameReport& report) {
  for (const ContactPatch& patch : s.patch) {
    report.contacts.add(patch.report);
    report.collision_us += 1e-3 * static_cast<double>(patch.spent_ns);
  }
}

}  // namespace bodice::cloth
