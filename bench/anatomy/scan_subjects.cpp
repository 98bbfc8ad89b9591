#include "scan_subjects.hpp"

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/body/proportions.hpp>

namespace bench {
namespace {

using bodice::engine::Random;
using bodice::geometry::Vec3;
using bodice::synth::ScanKind;

/// Small turns of trunk and head, arms and legs as the kind needs. The data's arms stand at 45 degrees at
/// rest.
Turns turns_of(ScanKind kind, Random& random) {
  Turns turns;
  for (const char* bone : {"spine04", "spine02", "neck01"})
    turns[bone] = turn(random.uniform(-3.0, 3.0), random.uniform(-4.0, 4.0), random.uniform(-2.0, 2.0));
  const bool seated = bodice::synth::sits(kind), hanging = bodice::synth::hangs_arms(kind);
  const double arms = hanging ? random.uniform(-38.0, -30.0) : random.uniform(-34.0, 42.0);
  for (const char* side : {".L", ".R"}) {
    const auto limb = [&](const std::string& bone, const Eigen::Quaterniond& left) {
      turns[bone + side] = side[1] == 'L' ? left : mirrored(left);
    };
    limb("upperarm01", turn(0.0, random.uniform(-12.0, 8.0),
                            seated ? random.uniform(-20.0, 0.0) : arms + random.uniform(-3.0, 3.0)));
    limb("lowerarm01", turn(0.0, random.uniform(-20.0, 0.0), 0.0));
    limb("upperleg01", seated ? turn(random.uniform(-95.0, -82.0), 0.0, random.uniform(2.0, 14.0))
                              : turn(random.uniform(-8.0, 5.0), 0.0, random.uniform(-2.0, 8.0)));
    limb("lowerleg01", turn(seated ? random.uniform(80.0, 95.0) : random.uniform(0.0, 8.0), 0.0, 0.0));
  }
  return turns;
}

Vec3 between_hips(const PosedBody& posed) {
  return 0.5 * (posed.joints.at("thigh_l") + posed.joints.at("thigh_r"));
}

/// Moves the body to stand on y = 0 around the y axis.
void stand(PosedBody& posed) {
  const auto box = bodice::geometry::bounding_box(posed.skin.positions);
  const Vec3 hips = between_hips(posed), by(-hips.x(), -box.low.y(), -hips.z());
  for (Vec3& p : posed.skin.positions) p += by;
  for (auto& [name, p] : posed.landmarks) p += by;
  for (auto& [name, p] : posed.joints) p += by;
}

}  // namespace

RealSubjects::RealSubjects(const std::filesystem::path& data) : bodies_(rigged_bodies(data)) {}

bodice::synth::Body RealSubjects::posed(ScanKind kind, std::uint64_t seed) const {
  Random random(seed, 0xB0D1 + static_cast<std::uint64_t>(kind));
  const RiggedBody& rigged = bodies_[random.below(bodies_.size())];
  PosedBody posed = pose(rigged, turns_of(kind, random));
  stand(posed);
  bodice::synth::Body body;
  body.mesh = std::move(posed.skin);
  body.joints.push_back({"pelvis", between_hips(posed)});
  for (int i = 0; i < bodice::body::kLandmarkCount; ++i) {
    const auto id = static_cast<bodice::body::LandmarkId>(i);
    const auto truth = posed.landmarks.find(std::string(bodice::body::name(id)));
    if (truth != posed.landmarks.end()) body.landmarks.push_back({id, truth->second, {}, 1.0});
  }
  body.stature_m = rigged.stature;
  return body;
}

std::optional<bodice::synth::ScanSubjects> RealSubjects::of(ScanKind kind, std::uint64_t seed) const {
  if (bodies_.empty()) return std::nullopt;
  bodice::synth::ScanSubjects subjects{posed(kind, 2 * seed), posed(kind, 2 * seed + 1)};
  bodice::synth::Body& body = subjects.body;
  auto found = bodice::anatomy::analyze({}, body.mesh, {bodice::body::find_profile("ansur2").value()});
  if (!found) return std::nullopt;
  body.part = std::move(found->part);
  for (const auto& truth : body.landmarks) found->landmarks[static_cast<std::size_t>(truth.id)] = truth;
  body.landmarks = std::move(found->landmarks);
  return subjects;
}

}  // namespace bench
