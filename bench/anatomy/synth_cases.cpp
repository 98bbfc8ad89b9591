#include <cmath>

#include <Eigen/Geometry>

#include <bodice/engine/random.hpp>
#include <bodice/synth/body.hpp>

#include "cases.hpp"

namespace bench {
namespace {

using bodice::body::Part;
using bodice::geometry::Vec3;

/// Sets the options of a child from two to about twelve years.
void make_child(bodice::engine::Random& random, bodice::synth::BodyOptions& o) {
  o.childhood = random.uniform(0.2, 1.0);
  o.stature_m = 1.55 - 0.69 * o.childhood;
  o.mass_kg = random.uniform(14.5, 22.0) * o.stature_m * o.stature_m;
}

bodice::synth::BodyOptions options_of(std::uint64_t seed) {
  using bodice::synth::Pose;
  bodice::engine::Random random(seed);
  bodice::synth::BodyOptions o;
  o.sex = random.below(2) == 0 ? bodice::body::Sex::kFemale : bodice::body::Sex::kMale;
  o.stature_m = random.uniform(1.45, 1.95);
  o.mass_kg = random.uniform(17.0, 42.0) * o.stature_m * o.stature_m;
  o.pose = static_cast<Pose>(random.below(static_cast<std::uint64_t>(Pose::kRandom) + 1));
  o.vertices = static_cast<int>(random.uniform(1500.0, 14000.0));
  o.seed = seed + 1;
  if (random.below(6) == 0) make_child(random, o);
  o.pregnant = o.childhood == 0.0 && o.sex == bodice::body::Sex::kFemale && random.below(6) == 0;
  return o;
}

std::string kind_of(const bodice::synth::BodyOptions& o) {
  constexpr const char* poses[] = {"A",     "T",   "arms down", "arms up", "stride",    "sit",
                                   "squat", "run", "kick",      "lying",   "handstand", "random"};
  if (o.childhood > 0.0) return "child";
  if (o.pregnant) return "pregnant";
  if (o.mass_kg > 35.0 * o.stature_m * o.stature_m) return "very heavy";
  return poses[static_cast<int>(o.pose)];
}

/// Any rotation, position and unit: none of them may matter.
void move_anywhere(std::uint64_t seed, Case& c) {
  bodice::engine::Random random(seed, 1);
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
  const double scale = std::pow(10.0, random.uniform(-3.0, 3.0));
  const Vec3 shift = 10.0 * scale * Vec3(random.normal(), random.normal(), random.normal());
  const auto moved = [&](const Vec3& p) { return Vec3(scale * (turn * p) + shift); };
  for (Vec3& p : c.mesh.positions) p = moved(p);
  for (auto& [name, p] : c.landmarks) p = moved(p);
  c.stature *= scale;
}

}  // namespace

Case synth_case(std::uint64_t seed) {
  Case c{"synth/" + std::to_string(seed), {}, {}, {}, 0.0, false};
  const auto options = options_of(seed);
  const auto body = bodice::synth::make_body({}, options);
  if (!body) return c;
  c.name += " pose " + std::to_string(static_cast<int>(options.pose)) + " bmi " +
            std::to_string(static_cast<int>(options.mass_kg / options.stature_m / options.stature_m)) +
            (options.childhood > 0.0 ? " child"
             : options.pregnant      ? " pregnant"
                                     : "");
  c.kind = kind_of(options);
  c.rest = options.pose == bodice::synth::Pose::kA || options.pose == bodice::synth::Pose::kT;
  c.mesh = body->mesh;
  for (const Part part : body->part) c.truth.push_back(coarse_class(part));
  for (const auto& mark : body->landmarks)
    c.landmarks[std::string(bodice::body::name(mark.id))] = mark.position;
  c.stature = body->stature_m;
  move_anywhere(seed, c);
  return c;
}

bodice::geometry::TriMesh synth_mesh(int vertices) {
  bodice::synth::BodyOptions options;
  options.vertices = vertices;
  auto body = bodice::synth::make_body({}, options);
  return body ? std::move(body->mesh) : bodice::geometry::TriMesh{};
}

}  // namespace bench
