#include "bodies.hpp"

#include <stdexcept>

#include <bodice/engine/executor.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>

#include "extremities/sides.hpp"
#include "landmarks/find_landmarks.hpp"

namespace calibrate {
namespace {

using bodice::synth::BodyOptions;
using bodice::synth::Pose;

/// Poses in which the trunk is as in the rest pose; arms that are raised lengthen paths over the chest.
constexpr std::array kUpright{Pose::kA, Pose::kT, Pose::kArmsDown, Pose::kArmsUp};

BodyOptions options_of(std::uint64_t seed, bool standing) {
  bodice::engine::Random random(seed, 0xCA11B);
  BodyOptions o;
  o.sex = random.below(2) == 0 ? bodice::body::Sex::kFemale : bodice::body::Sex::kMale;
  o.stature_m = random.uniform(1.45, 1.95);
  o.mass_kg = random.uniform(17.0, 42.0) * o.stature_m * o.stature_m;
  const auto pose = static_cast<Pose>(random.below(static_cast<std::uint64_t>(Pose::kRandom) + 1));
  o.pose = standing ? kUpright[random.below(kUpright.size())] : pose;
  o.vertices = static_cast<int>(random.uniform(4000.0, 9000.0));
  o.seed = seed + 1;
  if (random.below(6) == 0) {
    o.childhood = random.uniform(0.2, 1.0);
    o.stature_m = 1.55 - 0.69 * o.childhood;
    o.mass_kg = random.uniform(14.5, 22.0) * o.stature_m * o.stature_m;
  }
  o.pregnant = o.childhood == 0.0 && o.sex == bodice::body::Sex::kFemale && random.below(8) == 0;
  return o;
}

}  // namespace

Sample::Sample(std::uint64_t seed, bool standing) {
  const BodyOptions options = options_of(seed, standing);
  adult_ = options.childhood == 0.0;
  auto made = bodice::synth::make_body({}, options);
  if (!made) throw std::runtime_error(made.error().sentence());
  truth_ = std::move(*made);
  skin_ = std::make_unique<bodice::anatomy::Skin>(bodice::anatomy::make_skin({}, truth_.mesh));
  extremities_ = bodice::anatomy::find_extremities({}, *skin_);
  if (!extremities_) return;
  const auto sides = bodice::anatomy::find_sides({}, *skin_, *extremities_);
  tips_ = bodice::anatomy::in_body_order(*extremities_, sides);
  coordinates_ = std::make_unique<bodice::anatomy::BodyCoordinates>(bodice::engine::Context{}, *skin_, tips_);
  const Vec3& hand = truth_.mesh.positions[tips_.hand[0]];
  usable_ = (hand - landmark(bodice::body::LandmarkId::kFingertipL)).norm() < 0.1 * truth_.stature_m;
  if (usable_) (void)bodice::anatomy::find_landmarks({}, *skin_, *coordinates_, &records_);
}

Vec3 Sample::joint(const std::string& name) const {
  for (const auto& joint : truth_.joints)
    if (joint.name == name) return joint.position;
  throw std::runtime_error("no joint is named " + name);
}

std::vector<std::unique_ptr<Sample>> make_samples(const Draw& draw) {
  std::vector<std::unique_ptr<Sample>> samples(draw.count);
  const auto workers = bodice::engine::make_tbb_executor();
  const bodice::engine::Context context{.executor = workers.get()};
  bodice::engine::parallel_for(context, draw.count, 1, [&](std::size_t i, std::size_t) {
    samples[i] = std::make_unique<Sample>(draw.from + i, draw.standing);
  });
  std::erase_if(samples, [](const auto& s) { return !s->usable(); });
  return samples;
}

}  // namespace calibrate
