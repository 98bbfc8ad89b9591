#include "bodies.hpp"

#include <algorithm>
#include <stdexcept>

#include <bodice/engine/executor.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>

#include "extremities/sides.hpp"
#include "landmarks/find_landmarks.hpp"
#include "landmarks/stature.hpp"

namespace calibrate {
namespace {

using bodice::synth::BodyOptions;
using bodice::synth::Pose;

/// Seeds of random poses that no test and no other bench takes.
constexpr std::uint64_t kFirstPose = 950000;
/// A body of a file stands or moves as people do, and there are few; the poses made of them are random.
constexpr int kWeightOfFile = 10;
constexpr auto kLeftFingertip = bodice::body::LandmarkId::kFingertipL;
/// A hand that is farther from the true fingertip, as a fraction of the stature, is another extremity.
constexpr double kNearFingertip = 0.1;
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

Sample::Sample(std::uint64_t seed, bool standing) : person_(seed) {
  const BodyOptions options = options_of(seed, standing);
  adult_ = options.childhood == 0.0;
  if (options.pose == Pose::kA || options.pose == Pose::kT) group_ = Group::kMadeAtRest;
  auto made = bodice::synth::make_body({}, options);
  if (!made) throw std::runtime_error(made.error().sentence());
  truth_ = std::move(*made);
  stature_m_ = truth_.stature_m;
  for (const bodice::body::Part part : truth_.part) classes_.push_back(bench::coarse_class(part));
  for (const auto& mark : truth_.landmarks) landmarks_[static_cast<std::size_t>(mark.id)] = mark.position;
  for (const auto& joint : truth_.skeleton.joints)
    if (const auto id = bodice::body::joint_from_name(joint.name))
      joints_[static_cast<std::size_t>(*id)] = joint.bind.col(3);
  analyze();
}

Sample::Sample(const bench::Case& body, std::size_t person, Group group, int weight)
    : classes_(body.truth), stature_m_(body.stature), person_(person), weight_(weight), group_(group) {
  for (std::size_t id = 0; id < landmarks_.size(); ++id) {
    const auto found = body.landmarks.find(std::string(name(static_cast<bodice::body::LandmarkId>(id))));
    if (found != body.landmarks.end()) landmarks_[id] = found->second;
  }
  for (const auto& [joint, position] : body.joints)
    joints_[static_cast<std::size_t>(bodice::body::joint_from_name(joint).value())] = position;
  truth_.mesh = body.mesh;
  classes_.resize(body.mesh.positions.size(), -1);
  if (knows(kLeftFingertip) && stature_m_ > 0.0) analyze();
}

void Sample::analyze() {
  const bodice::geometry::TriMesh& mesh = truth_.mesh;
  skin_ = std::make_unique<bodice::anatomy::Skin>(bodice::anatomy::make_skin({}, mesh));
  extremities_ = bodice::anatomy::find_extremities({}, *skin_);
  if (!extremities_) return;
  const auto sides = bodice::anatomy::find_sides({}, *skin_, *extremities_);
  tips_ = bodice::anatomy::in_body_order(*extremities_, sides);
  coordinates_ = std::make_unique<bodice::anatomy::BodyCoordinates>(bodice::engine::Context{}, *skin_, tips_);
  const Vec3& hand = mesh.positions[tips_.hand[0]];
  usable_ = (hand - landmark(kLeftFingertip)).norm() < kNearFingertip * stature_m_;
}

bodice::anatomy::CorrectionRecords Sample::records(const bodice::anatomy::TrialCoefficients& trial) const {
  bodice::anatomy::CorrectionRecords records;
  records.trial = &trial;
  (void)bodice::anatomy::find_landmarks({}, *skin_, *coordinates_, &records);
  records.trial = nullptr;
  return records;
}

bool Sample::stands() const {
  const auto found = bodice::anatomy::find_landmarks({}, *skin_, *coordinates_);
  return bodice::anatomy::standing_height(*skin_, *coordinates_, found.marks, stature_m_).has_value();
}

Vec3 Sample::joint(const std::string& name) const {
  for (const auto& joint : truth_.joints)
    if (joint.name == name) return joint.position;
  throw std::runtime_error("no joint is named " + name);
}

std::optional<Vec3> Sample::skeleton_joint(bodice::body::JointId id) const {
  return joints_[static_cast<std::size_t>(id)];
}

namespace {

/// Makes samples side by side, and drops those that are not usable. `make` (index) returns one.
template <class Make>
OwnedSamples side_by_side(std::size_t count, Make&& make) {
  OwnedSamples samples(count);
  const auto workers = bodice::engine::make_tbb_executor();
  const bodice::engine::Context context{.executor = workers.get()};
  bodice::engine::parallel_for(context, count, 1, [&](std::size_t i, std::size_t) { samples[i] = make(i); });
  std::erase_if(samples, [](const auto& s) { return !s->usable(); });
  return samples;
}

}  // namespace

OwnedSamples make_samples(const Draw& draw) {
  return side_by_side(draw.count,
                      [&](std::size_t i) { return std::make_unique<Sample>(draw.from + i, draw.standing); });
}

OwnedSamples read_samples(const std::filesystem::path& data, std::size_t count) {
  std::vector<bench::Case> bodies = bench::rig_cases(data, kFirstPose, count);
  std::vector<std::string> people;
  for (const bench::Case& body : bodies)
    if (std::ranges::find(people, body.kind) == people.end()) people.push_back(body.kind);
  const std::size_t posed = bodies.size();
  for (bench::Case& body : bench::file_cases(data, "bodies/")) bodies.push_back(std::move(body));
  const auto person_of = [&](const bench::Case& body) {
    return static_cast<std::size_t>(
        std::ranges::find_if(
            people, [&](const std::string& name) { return body.name.find(name) != std::string::npos; }) -
        people.begin());
  };
  return side_by_side(bodies.size(), [&](std::size_t i) {
    const bench::Case& body = bodies[i];
    const Group of_file = body.rest ? Group::kFileAtRest : Group::kFilePosed;
    return i < posed ? std::make_unique<Sample>(body, person_of(body), Group::kRig, 1)
                     : std::make_unique<Sample>(body, person_of(body), of_file, kWeightOfFile);
  });
}

}  // namespace calibrate
