#include "faces/face_contact.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/schedule.hpp"
#include "base/tolerances.hpp"

namespace bodice::cloth {
namespace {

// Samples may sink by this share of the thickness between their neighbors.
constexpr float kSagOfThickness = 0.25f;
// The least of that, and of the widest spacing, as shares of the median edge: for thin cloth of any scale.
constexpr double kLeastSag = 0.005, kLeastSpacing = 0.5;
// The widest spacing, in thicknesses: 12 mm at 1.5 mm, where a fingertip of 8 mm reaches through by 2 mm.
constexpr double kSpacingOfThickness = 8.0;
// A sample is queried anew after a path of so many sags. On a surface of radius rho a linear distance is
// then off by (5 sag)^2 / (2 rho), a third of the sag at the finest features.
constexpr float kFresh = 5.0f;
// Memory for samples: that of the widest spacing at rest, times this, and some for each element.
constexpr std::size_t kRefined = 3, kMostAnElement = 2;
constexpr int kSweeps = 2;
constexpr std::size_t kChunkGrain = 16;   // chunks a task
constexpr std::size_t kQueryGrain = 512;  // particles a task

// Position of a sample in the body's pose at the end of the frame.
Float4 seen_by_body(const FaceSample& s, std::span<const Point> now, float remaining) {
  return position(s, now) + remaining * vector_of(s.ahead);
}

// Distance of a sample at this position, to first order.
float distance_at(const FaceSample& s, Float4 where) {
  return s.distance_m + dot3(vector_of(s.normal), where - vector_of(s.at));
}

// Whether a sample inside the body would be pushed toward the side that its particles lie on. Where a
// triangle spans a fold or cuts a limb, the closest surface may be on the other side of the limb; there only
// the particles, which know their paths, are moved out.
bool is_on_its_side(const FaceSample& s, const FaceContact& f) {
  const float weight[3] = {s.weight[0], s.weight[1], 1.0f - s.weight[0] - s.weight[1]};
  const Float4 normal = vector_of(s.normal);
  for (int c = 0; c < 3; ++c) {
    const collision::Contact& corner = f.nearest[s.particle[c]];
    const bool near = corner.signed_distance < f.rules.keep_m + f.rules.spacing_m;
    if (weight[c] > 0.0f && near && dot3(normal, vector_of(corner.normal)) < 0.0f) return false;
  }
  return true;
}

// Lists the samples of a chunk that may be too near, with distances that are good enough.
void refresh_chunk(const collision::Collider& body, const FaceSubstep& substep, std::size_t chunk,
                   FaceContact& f) {
  const SampleRules& r = f.rules;
  const float fresh_m = kFresh * r.sag_m;
  const auto [begin, end] = f.samples.chunk[chunk];
  SampleQuery query;
  std::uint32_t* const active = &f.active[begin];
  std::uint32_t count = 0;
  for (std::uint32_t k = begin; k < end; ++k) {
    const FaceSample& s = f.samples.all[k];
    const Float4 where = seen_by_body(s, f.now, substep.remaining), path = where - vector_of(s.at);
    const float path2 = dot3(path, path);
    const float far_m = s.distance_m - r.keep_m - r.rise_m;
    if (far_m > 0.0f && far_m * far_m > r.slope * r.slope * path2) continue;
    if (path2 > fresh_m * fresh_m)
      query.add(k, where);
    else if (distance_at(s, where) < s.keep_m + fresh_m && is_on_its_side(s, f))
      active[count++] = k;
  }
  query.run(body, band_of(r), r.frame_s, f.samples.all);
  for (std::size_t q = 0; q < query.count; ++q) {
    const FaceSample& s = f.samples.all[query.sample[q]];
    if (s.distance_m < s.keep_m + fresh_m && is_on_its_side(s, f)) active[count++] = query.sample[q];
  }
  f.active_count[chunk] = count;
}

// The longest push of a sample in a substep. What it came nearer in this substep is undone at once, and the
// rest at the recovery speed.
float longest_push(const FaceSample& s, const FaceSubstep& substep, const FaceContact& f,
                   const Particles& p) {
  const float weight[3] = {s.weight[0], s.weight[1], 1.0f - s.weight[0] - s.weight[1]};
  Float4 path = -(substep.length_s / f.rules.frame_s) * vector_of(s.ahead);
  for (int c = 0; c < 3; ++c) {
    const Index i = s.particle[c];
    path += weight[c] * (xyz(load(f.now[i])) - Float4{p.old_x[i], p.old_y[i], p.old_z[i], 0.0f});
  }
  return kFromBody_m_s * substep.length_s + std::sqrt(dot3(path, path));
}

// Moves the particles of a sample that is too near; returns whether it was.
bool push_out(const FaceSample& s, const FaceSubstep& substep, const Particles& p, FaceContact& f) {
  const float room = distance_at(s, seen_by_body(s, f.now, substep.remaining)) - s.keep_m;
  if (!(room < 0.0f)) return false;
  const float weight[3] = {s.weight[0], s.weight[1], 1.0f - s.weight[0] - s.weight[1]};
  float yielding = 0.0f;
  for (int c = 0; c < 3; ++c) yielding += f.now[s.particle[c]].weight * weight[c] * weight[c];
  if (!(yielding > 0.0f)) return true;
  float push = -room;
  if (push > kFromBody_m_s * substep.length_s) push = std::min(push, longest_push(s, substep, f, p));
  const Float4 normal = vector_of(s.normal);
  for (int c = 0; c < 3; ++c) {
    Point& point = f.now[s.particle[c]];
    store(point, load(point) + (push * point.weight * weight[c] / yielding) * normal);
  }
  return true;
}

// Calls visit(sample) for the active samples of a group, in order.
template <class Visit>
void for_each_active(const FaceContact& f, std::size_t group, Visit&& visit) {
  for (std::uint32_t c = f.samples.group_chunk[group]; c < f.samples.group_chunk[group + 1]; ++c) {
    const std::uint32_t* const active = &f.active[f.samples.chunk[c].begin];
    for (std::uint32_t k = 0; k < f.active_count[c]; ++k) visit(f.samples.all[active[k]]);
  }
}

// Calls visit(group) for all groups: those inside blocks in parallel, because they share no particle, then
// the one across blocks.
template <class Visit>
void for_each_group(const engine::Context& context, const FaceContact& f, Visit&& visit) {
  const std::size_t across = f.elements.groups() - 1;
  engine::parallel_for(context, across, 1, [&](std::size_t group, std::size_t) { visit(group); });
  visit(across);
}

}  // namespace

FaceContact make_face_contact(const geometry::TriMesh& mesh, const Topology& topology,
                              const SolverOptions& options, double median_edge_m,
                              const Particles& particles) {
  FaceContact f;
  if (!options.face_contact || options.response == collision::Response::kPaper) return f;
  f.elements = make_elements(mesh, topology);
  const double keep_m = options.thickness_m;
  f.rules.keep_m = static_cast<float>(keep_m);
  f.rules.sag_m = static_cast<float>(std::max(double{kSagOfThickness} * keep_m, kLeastSag * median_edge_m));
  f.rules.spacing_m =
      static_cast<float>(std::max(kSpacingOfThickness * keep_m, kLeastSpacing * median_edge_m));
  const std::size_t at_rest = count_at_rest(f.elements, particles, f.rules.spacing_m);
  const std::size_t most = kRefined * at_rest + kMostAnElement * f.elements.all.size();
  f.samples = make_face_samples(f.elements, most);
  f.active.resize(most);
  f.active_count.assign(most / kChunk + f.elements.groups() + 1, 0);
  f.group_contacts.resize(f.elements.groups());
  f.nearest.resize(particles.count()), f.now.resize(particles.count());
  return f;
}

void query_particles(const engine::Context& context, const collision::Collider& body, FaceContact& f,
                     Particles& p) {
  const engine::Context alone{.executor = &engine::inline_executor()};
  engine::parallel_for(context, p.count(), kQueryGrain, [&](std::size_t begin, std::size_t end) {
    const collision::Particles run{
        .count = end - begin, .x = &p.x[begin], .y = &p.y[begin], .z = &p.z[begin]};
    body.query(alone, run, std::span(f.nearest).subspan(begin, end - begin));
  });
}

void begin_face_frame(const engine::Context& context, const collision::Collider& body, double frame_s,
                      const Environment& environment, const MotionNearParticles& motion, const Particles& p,
                      FaceContact& f) {
  const Steepness& steepness = body.has_relief() ? kReliefSteepness : kPlainSteepness;
  f.rules.slope = steepness.slope, f.rules.rise_m = steepness.rise_m;
  f.rules.frame_s = static_cast<float>(frame_s);
  f.rules.fall_m = static_cast<float>(frame_s * frame_s * environment.gravity_m_s2.norm());
  std::ranges::fill(f.group_contacts, std::uint64_t{0});
  place_samples(context, body, f.rules, f.elements, f.nearest, motion, p, f.samples);
  f.on = !f.samples.all.empty();
}

void push_faces_out(const engine::Context& context, const collision::Collider& body,
                    const FaceSubstep& substep, Particles& p, FaceContact& f) {
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) f.now[i] = {p.x[i], p.y[i], p.z[i], p.point[i].weight};
  });
  engine::parallel_for(context, f.samples.chunk.size(), kChunkGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) refresh_chunk(body, substep, c, f);
  });
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for_each_group(context, f, [&](std::size_t group) {
      for_each_active(f, group, [&](const FaceSample& s) {
        const bool pushed = push_out(s, substep, p, f);
        if (sweep == 0) f.group_contacts[group] += pushed;
      });
    });
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) p.x[i] = f.now[i].x, p.y[i] = f.now[i].y, p.z[i] = f.now[i].z;
  });
}

FaceReport report_faces(const FaceContact& f) {
  FaceReport report;
  report.samples = f.samples.all.size();
  for (std::size_t group = 0; group < f.elements.groups(); ++group) {
    report.contacts += f.group_contacts[group];
    for_each_active(f, group, [&](const FaceSample& s) {
      report.deepest_m = std::max(report.deepest_m, -distance_at(s, seen_by_body(s, f.now, 0.0f)));
    });
  }
  return report;
}

}  // namespace bodice::cloth
