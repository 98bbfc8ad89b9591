#include "faces/face_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <bodice/engine/parallel.hpp>

#include "base/schedule.hpp"
#include "base/tolerances.hpp"
#include "faces/own_side.hpp"
#include "faces/push_sample.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// Between two samples a point may be nearer to the body than the thickness by this share of it.
constexpr float kSagOfThickness = 0.25f;
// Lower bounds of that distance and of the widest spacing, as shares of the median edge. They keep the number
// of samples bounded for thin cloth.
constexpr double kLeastSag = 0.005, kLeastSpacing = 0.5;
// The widest spacing, in thicknesses: 12 mm at 1.5 mm, where a fingertip of 8 mm reaches through by 2 mm.
constexpr double kSpacingOfThickness = 8.0;
// A sample is queried anew after a path of this many sags. A linear distance to a surface of radius rho is
// then wrong by (5 sag)^2 / (2 rho), which is a third of the sag at the finest features.
constexpr float kFresh = 5.0f;
// Memory is reserved for this multiple of the samples that the widest spacing gives at rest, and for
// kMostAnElement samples of each element.
constexpr std::size_t kRefined = 3, kMostAnElement = 2;
constexpr int kSweeps = 2;
constexpr std::size_t kRunGrain = 16;     // runs a task
constexpr std::size_t kQueryGrain = 512;  // particles a task
constexpr std::size_t kWorthTasks = 512;  // with fewer samples to test, tasks cost more time than they save
constexpr float kNever_m = 1e9f;
constexpr float kRounding = 1.00001f;  // travel is rounded upward

bool is_due(const RunState& run) {
  return !(run.next_m > run.travel_m);
}

// How far the shift of a sample differs from the shift that its particles' shifts give by its weights,
// meters.
float shift_mismatch_m(const FaceSample& s, const FaceContact& f) {
  if (!f.motion.moving) return 0.0f;
  const std::array<float, 3> weight = weights_of(s);
  Float4 off = -vector_of(s.shift);
  for (int c = 0; c < 3; ++c) off += weight[c] * xyz(load(f.motion.shift[s.particle[c]]));
  return std::sqrt(dot(off, off));
}

// The result of a sample's test. It needs a `query` if its distance is out of date, is `active` if it may be
// too near, and is `behind` if the closest surface is on the wrong side. Otherwise it needs no test until it
// has traveled `quiet_m`.
struct SampleTest {
  bool query = false, active = false, behind = false;
  float quiet_m = 0.0f;
};

SampleTest classify(const FaceSample& s, Float4 where, const FaceContact& f) {
  const SampleRules& r = f.rules;
  const Float4 from = where - vector_of(s.at);
  const float path = std::sqrt(dot(from, from));
  const float far_m = (s.distance_m - r.keep_m - r.rise_m) / r.slope - path;
  if (far_m > 0.0f) return {.quiet_m = far_m};
  const float stale_m = kFresh * r.sag_m - path;
  if (stale_m < 0.0f) return {.query = true};
  const float room_m = distance_at(s, where) - s.keep_m - r.sag_m;
  if (room_m > 0.0f) return {.quiet_m = std::min(stale_m, room_m)};
  if (is_on_its_side(s, f)) return {.active = true};
  return {.behind = true, .quiet_m = stale_m};
}

// Tests the samples of a run that may have come too near. Queries samples with distances that are out of
// date, and lists samples to push.
void refresh_run(const collision::Collider& body, const FaceSubstep& substep, std::size_t run,
                 FaceContact& f) {
  RunState& state = f.travel.run[run];
  const auto [begin, end] = f.samples.of_run(f.elements, run);
  state.active = 0, state.next_m = kNever_m;
  SampleQuery query;
  const auto store_result = [&](std::uint32_t k, SampleTest result) {
    FaceSample& sample = f.samples.all[k];
    if (result.behind && move_to_own_side(body, f, sample))
      result = classify(sample, vector_of(sample.at), f);
    const float quiet_m = result.quiet_m - substep.remaining * shift_mismatch_m(f.samples.all[k], f);
    f.travel.until_m[k] = result.active || !(quiet_m > 0.0f) ? 0.0f : state.travel_m + quiet_m;
    state.next_m = std::min(state.next_m, f.travel.until_m[k]);
    if (result.active) f.travel.active[begin + state.active++] = k;
  };
  const auto run_query = [&] {
    const std::size_t count = query.count;
    query.run(body, f.rules, f.motion, f.samples.all);
    for (std::size_t q = 0; q < count; ++q) {
      const std::uint32_t k = query.sample[q];
      store_result(k, classify(f.samples.all[k], vector_of(f.samples.all[k].at), f));
    }
  };
  for (std::uint32_t k = begin; k < end; ++k) {
    if (f.travel.until_m[k] > state.travel_m) {
      state.next_m = std::min(state.next_m, f.travel.until_m[k]);
      continue;
    }
    const Float4 where = in_end_pose(f.samples.all[k], f.now, substep.remaining);
    const SampleTest result = classify(f.samples.all[k], where, f);
    if (!result.query) {
      store_result(k, result);
      continue;
    }
    query.add(k, where);
    if (query.is_full()) run_query();
  }
  run_query();
}

// Adds the substep's travel to all runs; returns the number of samples in runs that need a test.
std::size_t travel(FaceContact& f) {
  std::size_t work = 0;
  for (std::size_t run = 0; run < f.travel.run.size(); ++run) {
    float longest = 0.0f;
    for (const std::uint32_t cluster : f.elements.clusters_of(run))
      longest = std::max(longest, f.travel.step_m[cluster]);
    f.travel.run[run].travel_m += kRounding * longest;
    if (!is_due(f.travel.run[run])) continue;
    const auto [begin, end] = f.samples.of_run(f.elements, run);
    work += end - begin;
  }
  return work;
}

// Calls visit(sample) for the active samples of a group, in order.
template <class Visit>
void for_each_active(const FaceContact& f, std::size_t group, Visit&& visit) {
  for (std::uint32_t run = f.elements.group_run[group]; run < f.elements.group_run[group + 1]; ++run) {
    const std::uint32_t* const active = f.travel.active.data() + f.samples.of_run(f.elements, run).begin;
    for (std::uint32_t k = 0; k < f.travel.run[run].active; ++k) visit(f.samples.all[active[k]]);
  }
}

// Pushes the active samples of all groups: those inside blocks in parallel, because they share no particle,
// then the one across blocks. Returns the number of samples that were pushed.
std::uint64_t push_all(const engine::Context& context, const FaceSubstep& substep, const Particles& p,
                       FaceContact& f) {
  const std::size_t across = f.elements.groups() - 1;
  const auto push_group = [&](std::size_t group) {
    std::uint64_t pushed = 0;
    for_each_active(f, group, [&](const FaceSample& s) { pushed += push_out(s, substep, p, f); });
    f.group_pushed[group] = pushed;
  };
  engine::parallel_for(context, across, 1, [&](std::size_t group, std::size_t) { push_group(group); });
  push_group(across);
  return std::accumulate(f.group_pushed.begin(), f.group_pushed.end(), std::uint64_t{0});
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
  f.samples = make_face_samples(f.elements, particles.count(), most);
  f.travel.active.resize(most), f.travel.until_m.resize(most);
  f.travel.run.resize(f.elements.runs()), f.group_pushed.resize(f.elements.groups());
  f.nearest.resize(particles.count()), f.now.resize(particles.count()), f.unpushed.resize(particles.count());
  f.travel.step_m.resize(engine::block_count(particles.count(), kTravelCluster));
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

void begin_face_frame(const engine::Context& context, const ContactFrame& frame,
                      const Environment& environment, const MotionNearParticles& motion, const Particles& p,
                      FaceContact& f) {
  const Steepness& steepness = frame.body->has_relief() ? kReliefSteepness : kPlainSteepness;
  f.rules.slope = steepness.slope, f.rules.rise_m = steepness.rise_m;
  f.rules.frame_s = static_cast<float>(frame.length_s);
  f.rules.fall_m =
      static_cast<float>(0.5 * frame.length_s * frame.length_s * environment.gravity_m_s2.norm());
  f.contacts = 0;
  f.motion = motion;
  place_samples(context, {*frame.body, f.nearest, motion}, f.rules, f.elements, p, f.samples);
  f.on = !f.samples.all.empty();
  std::ranges::fill(f.travel.run, RunState{});
  std::fill_n(f.travel.until_m.begin(), f.samples.all.size(), 0.0f);
  for (std::size_t i = 0; i < p.count(); ++i) f.unpushed[i] = {p.x[i], p.y[i], p.z[i], 0.0f};
}

void begin_face_substep(const FaceSubstep& substep, std::size_t begin, std::size_t end, const Particles& p,
                        FaceContact& f) {
  for (std::size_t from = begin; from < end; from += kTravelCluster) {
    float longest2 = 0.0f;
    for (std::size_t i = from; i < std::min(from + kTravelCluster, end); ++i) {
      const Float4 at = load(p.point[i]);
      Float4 path = xyz(at) - load(f.unpushed[i]);
      if (f.motion.moving) path -= substep.share * xyz(load(f.motion.shift[i]));
      longest2 = std::max(longest2, dot(path, path));
      store(f.unpushed[i], xyz(at)), store(f.now[i], at);
    }
    f.travel.step_m[from / kTravelCluster] = std::sqrt(longest2);
  }
}

void end_face_substep(std::size_t begin, std::size_t end, const FaceContact& f, Particles& p) {
  for (std::size_t i = begin; i < end; ++i) p.x[i] = f.now[i].x, p.y[i] = f.now[i].y, p.z[i] = f.now[i].z;
}

void push_faces_out(const engine::Context& context, const collision::Collider& body,
                    const FaceSubstep& substep, const Particles& p, FaceContact& f) {
  const std::size_t work = travel(f);
  if (work == 0) return;
  engine::Context how = context;
  if (work < kWorthTasks) how.executor = &engine::inline_executor();
  engine::parallel_for(how, f.travel.run.size(), kRunGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t run = begin; run < end; ++run)
      if (is_due(f.travel.run[run])) refresh_run(body, substep, run, f);
  });
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const std::uint64_t pushed = push_all(how, substep, p, f);
    if (sweep == 0) f.contacts += pushed;
    if (pushed == 0) return;  // nothing moved, and nothing would
  }
}

FaceReport report_faces(const FaceContact& f) {
  FaceReport report;
  report.samples = f.samples.all.size();
  report.contacts = f.contacts;
  for (std::size_t group = 0; group < f.elements.groups(); ++group) {
    for_each_active(f, group, [&](const FaceSample& s) {
      report.deepest_m = std::max(report.deepest_m, -distance_at(s, in_end_pose(s, f.now, 0.0f)));
    });
  }
  return report;
}

}  // namespace bodice::cloth
