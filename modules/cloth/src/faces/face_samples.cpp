#include "faces/face_samples.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr std::size_t kElementGrain = 1024;
constexpr std::size_t kQueriedRuns = 16;  // runs a task of queries
// Samples are placed where cloth may come near the body if it moves this multiple of the path that its speed
// gives. Constraints pull some cloth faster.
constexpr float kSpare = 2.0f;
constexpr float kFarthest_m = 1e6f;  // in place of an infinite distance

Float4 at(const Particles& p, Index i) {
  return Float4{p.x[i], p.y[i], p.z[i], 0.0f};
}
float length(Float4 v) {
  return std::sqrt(dot(v, v));
}

float length2(Float4 v) {
  return dot(v, v);
}

// The data by which the samples of one frame are chosen.
struct Placement {
  const SampleRules& rules;
  const Particles& p;
  BodyNearParticles near;
  std::span<ParticleRoom> room;
  float widening = 1.0f;  // factor on all spacings; above 1 where memory does not suffice

  float longest2(const Element& e) const {
    const auto [a, b, c] = e.particle;
    const float ab = length2(at(p, a) - at(p, b));
    return e.is_edge() ? ab : std::max({ab, length2(at(p, b) - at(p, c)), length2(at(p, c) - at(p, a))});
  }
  // How much farther from the body particle i stays within the frame than the distance to keep.
  float to_spare(Index i) const {
    return std::max(0.0f, room[i].distance_m - room[i].reach_m - rules.keep_m);
  }
  // The allowed error of the distance interpolated between samples of the element. Where all corners stay
  // far, it is larger.
  float sag(const Element& e) const {
    const auto [a, b, c] = e.particle;
    return rules.sag_m + std::min({to_spare(a), to_spare(b), to_spare(c)});
  }
  // The number of parts that the edge from i to j needs, if the interpolated distance may err by `allowed_m`.
  float parts(Index i, Index j, float allowed_m) const {
    const Float4 edge = at(p, j) - at(p, i);
    const float by_length = length(edge) / (rules.spacing_m * widening);
    const collision::Contact &a = near.nearest[i], &b = near.nearest[j];
    if (a.ellipsoid == collision::kNoEllipsoid || b.ellipsoid == collision::kNoEllipsoid) return by_length;
    const float sag = dot(vector_of(b.normal) - vector_of(a.normal), edge) / 8.0f;
    return std::max(by_length, std::sqrt(std::max(0.0f, sag) / allowed_m) / widening);
  }
};

void find_room(const engine::Context& context, const Placement& how) {
  const SampleRules& r = how.rules;
  engine::parallel_for(context, how.p.count(), kElementGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Float4 path = Float4{how.p.vx[i], how.p.vy[i], how.p.vz[i], 0.0f} * r.frame_s -
                          xyz(load(how.near.motion.shift[i]));
      how.room[i] = {std::min(how.near.nearest[i].signed_distance, kFarthest_m),
                     kSpare * (length(path) + r.fall_m)};
    }
  });
}

// Whether a point of the element may come to the body within the frame. A distance changes by no more than
// the point moves, and a point's distances from the corners sum to at most twice the longest side.
bool is_near(const Placement& how, const Element& e) {
  float reach = 0.0f, distances = 0.0f;
  const int corners = e.is_edge() ? 2 : 3;
  for (int c = 0; c < corners; ++c) {
    const ParticleRoom& room = how.room[e.particle[c]];
    reach = std::max(reach, room.reach_m), distances += room.distance_m;
  }
  reach += how.rules.keep_m + how.rules.rise_m;
  const float beyond = distances - static_cast<float>(corners) * reach;
  const float most = static_cast<float>(corners - 1);
  return beyond < 0.0f || beyond * beyond < most * most * how.longest2(e);
}

int parts_of(const Placement& how, const Element& e, int wanted) {
  const auto [a, b, c] = e.particle;
  if (!is_near(how, e)) return 0;
  const float sag = how.sag(e);
  float parts = how.parts(a, b, sag);
  if (!e.is_edge()) parts = std::max({parts, how.parts(b, c, sag), how.parts(c, a, sag)});
  parts = std::max(parts, static_cast<float>(wanted) / how.widening);
  return std::clamp(static_cast<int>(std::ceil(std::min(parts, 1e3f))), 1, kFinest);
}

// Sets the parts of all elements and the first sample of each; returns the number of samples.
std::size_t count_samples(const engine::Context& context, const Placement& how, const Elements& elements,
                          FaceSamples& s) {
  const auto samples_of = [&](std::size_t e) {
    return s.parts[e] > 1 ? lattice_points(elements.all[e].is_edge(), s.parts[e]) : std::size_t{0};
  };
  const std::size_t count = elements.all.size();
  engine::parallel_for(context, count, kElementGrain, [&](std::size_t begin, std::size_t end) {
    std::size_t& samples = s.before_block[begin / kElementGrain] = 0;
    for (std::size_t e = begin; e < end; ++e) {
      s.parts[e] = static_cast<std::uint8_t>(parts_of(how, elements.all[e], s.wanted[e]));
      samples += samples_of(e);
    }
  });
  std::size_t total = 0;
  for (std::size_t& before : s.before_block) total += std::exchange(before, total);
  engine::parallel_for(context, count, kElementGrain, [&](std::size_t begin, std::size_t end) {
    std::size_t before = s.before_block[begin / kElementGrain];
    for (std::size_t e = begin; e < end; ++e) {
      s.begin[e] = static_cast<std::uint32_t>(std::min(before, s.most + 1));
      before += samples_of(e);
    }
  });
  s.begin[count] = static_cast<std::uint32_t>(std::min(total, s.most + 1));
  return total;
}

void write_samples(const Element& element, int parts, FaceSample* out) {
  if (parts < 2) return;
  for_each_lattice_point(element.is_edge(), parts, [&](float b1, float b2) {
    FaceSample& sample = *out++;
    std::ranges::copy(element.particle, sample.particle);
    // The weights of an edge are those of its first and second particle; of a triangle, of its last two.
    sample.weight[0] = element.is_edge() ? b1 : 1.0f - b1 - b2;
    sample.weight[1] = element.is_edge() ? b2 : b1;
  });
}

// How much less than the thickness samples beside particle i keep: nothing, unless it is a pin that the host
// holds nearer to the body.
float deficit(const Placement& how, Index i) {
  return how.p.inverse_mass[i] > 0.0f ? 0.0f : std::max(0.0f, how.rules.keep_m - how.room[i].distance_m);
}

void query_samples(const Placement& how, const SampleRange& range, std::span<FaceSample> samples) {
  const collision::Collider& body = how.near.body;
  const MotionNearParticles& motion = how.near.motion;
  SampleQuery query;
  for (std::uint32_t k = range.begin; k < range.end; ++k) {
    FaceSample& s = samples[k];
    const std::array<float, 3> weight = weights_of(s);
    Float4 where = splat(0.0f), shift = splat(0.0f);
    s.keep_m = how.rules.keep_m;
    for (int c = 0; c < 3; ++c) {
      const Index i = s.particle[c];
      where += weight[c] * at(how.p, i), shift += weight[c] * xyz(load(motion.shift[i]));
      s.keep_m -= weight[c] * deficit(how, i);
    }
    for (int axis = 0; axis < 3; ++axis) s.shift[axis] = shift[axis];
    query.add(k, where + shift);
    if (query.is_full()) query.run(body, how.rules, motion, samples);
  }
  query.run(body, how.rules, motion, samples);
}

// The number of parts that an element needs in the next frame, by how fast normals turn between its samples.
int wanted_parts(const Placement& how, const Elements& elements, const FaceSamples& s, std::size_t e) {
  // The number falls by one a frame only, because samples would otherwise come and go.
  const int kept = std::max(0, s.wanted[e] - 1);
  if (s.begin[e + 1] <= s.begin[e] + 1) return kept;
  float sharpest = 0.0f;  // turn of the normals, a length of path
  for (std::uint32_t k = s.begin[e]; k + 1 < s.begin[e + 1]; ++k) {
    const FaceSample &a = s.all[k], &b = s.all[k + 1];
    const Float4 path = vector_of(b.at) - vector_of(a.at);
    const float turn = dot(vector_of(b.normal) - vector_of(a.normal), path);
    if (turn > 0.0f) sharpest = std::max(sharpest, turn / dot(path, path));
  }
  const Element& element = elements.all[e];
  const float wanted = std::sqrt(how.longest2(element) * sharpest / (8.0f * how.sag(element)));
  return std::clamp(static_cast<int>(std::ceil(std::min(wanted, 1e3f))), kept, kFinest);
}

}  // namespace

FaceSamples make_face_samples(const Elements& elements, std::size_t particles, std::size_t most) {
  FaceSamples s;
  s.room.resize(particles);
  s.most = most;
  s.all.reserve(most);
  s.begin.assign(elements.all.size() + 1, 0);
  s.before_block.resize(engine::block_count(elements.all.size(), kElementGrain));
  s.parts.assign(elements.all.size(), 0), s.wanted.assign(elements.all.size(), 0);
  return s;
}

std::size_t count_at_rest(const Elements& elements, const Particles& p, float spacing_m) {
  std::size_t total = 0;
  for (const Element& e : elements.all) {
    const auto [a, b, c] = e.particle;
    const float longest =
        std::max({length(at(p, a) - at(p, b)), length(at(p, b) - at(p, c)), length(at(p, c) - at(p, a))});
    const float parts = std::clamp(std::ceil(longest / spacing_m), 1.0f, static_cast<float>(kFinest));
    total += lattice_points(e.is_edge(), static_cast<int>(parts));
  }
  return total;
}

void set_contact(const collision::Collider& body, const MotionNearParticles& motion,
                 const collision::Contact& contact, float frame_s, FaceSample& s) {
  s.distance_m = contact.signed_distance;
  std::ranges::copy(contact.normal, s.normal);
  if (!motion.moving) return;
  const Vec3 velocity =
      body.surface_velocity(contact.ellipsoid, Eigen::Map<const Eigen::Vector3f>(s.at).cast<double>());
  const Eigen::Vector3f by = (double{frame_s} * velocity).cast<float>();
  const Eigen::Map<const Eigen::Vector3f> normal(s.normal);
  Eigen::Map<Eigen::Vector3f>(s.shift) =
      motion.follow * by + (1.0f - motion.follow) * by.dot(normal) * normal;
}

void SampleQuery::run(const collision::Collider& body, const SampleRules& rules,
                      const MotionNearParticles& motion, std::span<FaceSample> samples) {
  if (count == 0) return;
  const float band_m = band_of(rules);
  const engine::Context alone{.executor = &engine::inline_executor()};
  body.query(alone, {.count = count, .x = x, .y = y, .z = z}, {contact, count}, {.within_m = band_m});
  for (std::size_t k = 0; k < count; ++k) {
    FaceSample& s = samples[sample[k]];
    const collision::Contact& c = contact[k];
    s.at[0] = x[k], s.at[1] = y[k], s.at[2] = z[k];
    const bool near = c.ellipsoid != collision::kNoEllipsoid;
    s.distance_m = band_m;
    for (float& n : s.normal) n = 0.0f;
    if (near) set_contact(body, motion, c, rules.frame_s, s);
  }
  count = 0;
}

void place_samples(const engine::Context& context, const BodyNearParticles& near, const SampleRules& rules,
                   const Elements& elements, const Particles& p, FaceSamples& s) {
  Placement how{rules, p, near, s.room};
  find_room(context, how);
  std::size_t count = count_samples(context, how, elements, s);
  while (count > s.most && how.widening < static_cast<float>(kFinest)) {
    how.widening *= 1.5f;
    count = count_samples(context, how, elements, s);
  }
  s.all.resize(std::min(count, s.most));
  if (count > s.most) std::ranges::fill(s.begin, 0u), s.all.clear();
  engine::parallel_for(context, elements.all.size(), kElementGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e)
      if (s.begin[e + 1] > s.begin[e]) write_samples(elements.all[e], s.parts[e], &s.all[s.begin[e]]);
  });
  engine::parallel_for(context, elements.runs(), kQueriedRuns, [&](std::size_t begin, std::size_t end) {
    query_samples(how, {s.of_run(elements, begin).begin, s.begin[elements.run_begin[end]]}, s.all);
  });
  engine::parallel_for(context, elements.all.size(), kElementGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e)
      s.wanted[e] = static_cast<std::uint8_t>(wanted_parts(how, elements, s, e));
  });
}

}  // namespace bodice::cloth
