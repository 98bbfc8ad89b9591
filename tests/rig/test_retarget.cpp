#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include <bodice/rig/retarget.hpp>
#include <bodice/rig/rig.hpp>

#include "random_rig.hpp"

using namespace bodice::rig;
using namespace rig_test;
using bodice::engine::Random;
using Eigen::Quaterniond;

namespace {

constexpr const char* kParts[] = {"hips",    "spine", "chest",    "neck",    "head", "thigh",
                                  "calf",    "foot",  "thigh",    "calf",    "foot", "upperarm",
                                  "forearm", "hand",  "upperarm", "forearm", "hand"};

/// A figure of 17 joints; arms at `arms` radians below level. `names` gives each joint's name, in the order
/// of kParts, left before right.
Skeleton figure(double scale, double arms, const std::vector<std::string>& names, double front = 0.0) {
  const Vec3 arm(std::cos(arms), -std::sin(arms), 0.0), right_arm(-arm.x(), arm.y(), 0.0);
  const std::vector<std::pair<int, Vec3>> bones = {
      {-1, {0, 0.9, 0}},     {0, {0, 0.1, 0}},     {1, {0, 0.2, 0}},    {2, {0, 0.25, 0}},
      {3, {0, 0.1, 0}},      {0, {0.1, -0.05, 0}}, {5, {0, -0.4, 0}},   {6, {0, -0.4, 0}},
      {0, {-0.1, -0.05, 0}}, {8, {0, -0.4, 0}},    {9, {0, -0.4, 0}},   {2, {0.2, 0.2, 0}},
      {11, 0.28 * arm},      {12, 0.25 * arm},     {2, {-0.2, 0.2, 0}}, {14, 0.28 * right_arm},
      {15, 0.25 * right_arm}};
  Skeleton skeleton;
  for (std::size_t j = 0; j < bones.size(); ++j) {
    Joint joint;
    joint.name = names[j];
    joint.parent = bones[j].first;
    joint.local.translation = scale * bones[j].second;
    skeleton.joints.push_back(joint);
  }
  skeleton.joints[0].local.rotation = Quaterniond(Eigen::AngleAxisd(front, Vec3::UnitY()));
  return skeleton;
}

std::vector<std::string> plain_names() {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < 17; ++j)
    names.push_back(std::string(kParts[j]) + (j < 5 ? "" : j < 8 || (j > 10 && j < 14) ? "_l" : "_r"));
  return names;
}

const std::vector<std::string> kMixamo = {
    "mixamorig:Hips",        "mixamorig:Spine",     "mixamorig:Spine1",    "mixamorig:Neck",
    "mixamorig:Head",        "mixamorig:LeftUpLeg", "mixamorig:LeftLeg",   "mixamorig:LeftFoot",
    "mixamorig:RightUpLeg",  "mixamorig:RightLeg",  "mixamorig:RightFoot", "mixamorig:LeftArm",
    "mixamorig:LeftForeArm", "mixamorig:LeftHand",  "mixamorig:RightArm",  "mixamorig:RightForeArm",
    "mixamorig:RightHand"};

Clip random_clip(const Skeleton& skeleton, std::uint64_t seed) {
  Random random(seed);
  Clip clip{"dance", 1.0, {}};
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    Track track;
    track.joint = static_cast<std::uint16_t>(j);
    track.rotation.time_s = {0.0, 0.5, 1.0};
    for (int k = 0; k < 3; ++k) track.rotation.value.push_back(random_turn(random));
    clip.tracks.push_back(track);
  }
  clip.tracks[0].translation = {
      Interpolation::kLinear, {0.0, 1.0}, {skeleton.joints[0].local.translation, Vec3(0.3, 1.0, 0.2)}};
  return clip;
}

/// Unit vector from one joint to another in a pose.
Vec3 direction(const Skeleton& skeleton, const Clip& clip, double time_s, std::size_t from, std::size_t to) {
  std::vector<Affine> world(skeleton.joints.size());
  joint_matrices(skeleton, clip, time_s, world);
  return (world[to].col(3) - world[from].col(3)).normalized();
}

}  // namespace

TEST_CASE("retargeting: to the same skeleton, every joint stands at each key where it stood") {
  const Skeleton skeleton = figure(1.0, 0.7, plain_names());
  const Clip clip = random_clip(skeleton, 1);
  const auto same = retarget(skeleton, clip, skeleton);
  REQUIRE(same.ok());
  CHECK(same->report.matched.size() == 17);
  CHECK(same->report.root_scale == 1.0);
  std::vector<Affine> a(17), b(17);
  for (const double t : {0.0, 0.5, 1.0}) {
    joint_matrices(skeleton, clip, t, a);
    joint_matrices(skeleton, same->clip, t, b);
    for (std::size_t j = 0; j < 17; ++j) CHECK((a[j] - b[j]).norm() < 1e-12);
  }
}

TEST_CASE(
    "retargeting: limbs point where the source's point, although arms hang in one rest pose and not in the "
    "other, names follow another convention, and the target is larger and faces elsewhere") {
  const double quarter = std::numbers::pi / 2;
  const Skeleton source = figure(1.0, 0.0, kMixamo);
  for (const double front : {0.0, quarter}) {
    const Skeleton target = figure(1.5, 1.2, plain_names(), front);
    const Clip clip = random_clip(source, 2);
    const auto carried = retarget(source, clip, target);
    REQUIRE(carried.ok());
    CHECK(carried->report.matched.size() == 17);  // spine and chest by their height
    CHECK(carried->report.root_scale == doctest::Approx(1.5));
    const Quaterniond turned(Eigen::AngleAxisd(front, Vec3::UnitY()));
    for (const double t : {0.0, 0.5, 1.0})
      for (const auto& [from, to] :
           std::map<std::size_t, std::size_t>{{5, 6}, {6, 7}, {8, 9}, {11, 12}, {12, 13}, {15, 16}})
        CHECK((direction(target, carried->clip, t, from, to) - turned * direction(source, clip, t, from, to))
                  .norm() < 1e-9);
    std::vector<Affine> world(17);
    joint_matrices(target, carried->clip, 1.0, world);
    const Vec3 moved = turned * (1.5 * (Vec3(0.3, 1.0, 0.2) - Vec3(0, 0.9, 0)));
    CHECK((world[0].col(3) - Vec3(0, 1.35, 0) - moved).norm() < 1e-9);
  }
}

TEST_CASE("retargeting: a skeleton without names in common is refused, one with a part of them reported") {
  const Skeleton source = figure(1.0, 0.0, kMixamo);
  std::vector<std::string> odd;
  for (int j = 0; j < 17; ++j) odd.push_back("x" + std::to_string(j));
  const auto none = retarget(source, random_clip(source, 3), figure(1.0, 0.0, odd));
  REQUIRE(!none.ok());
  CHECK(none.error().message.find("'dance'") != std::string::npos);
  std::vector<std::string> some = plain_names();
  some[16] = "claw";
  const auto part = retarget(source, random_clip(source, 3), figure(1.0, 0.0, some));
  REQUIRE(part.ok());
  CHECK(part->report.unmatched_target == std::vector<std::string>{"claw"});
  CHECK(part->report.unmatched_source == std::vector<std::string>{"mixamorig:RightHand"});
}

TEST_CASE("retargeting: a rest pose with the hips at the origin, as BVH files have, stands on the ground") {
  Skeleton source = figure(1.0, 0.0, kMixamo);
  const Skeleton target = figure(2.0, 0.0, plain_names());
  Clip clip{"stand and hop", 1.0, {Track{}}};
  clip.tracks[0].translation = {Interpolation::kLinear, {0.0, 1.0}, {Vec3(0, 0.9, 0), Vec3(0, 1.2, 0)}};
  source.joints[0].local.translation.setZero();
  const auto carried = retarget(source, clip, target);
  REQUIRE(carried.ok());
  std::vector<Affine> world(17);
  // Standing, the ankles of the source are at .05. Those of the target belong where its rest pose has them.
  joint_matrices(target, carried->clip, 0.0, world);
  CHECK(world[0](1, 3) == doctest::Approx(1.8));
  joint_matrices(target, carried->clip, 1.0, world);
  CHECK(world[0](1, 3) == doctest::Approx(1.8 + 2.0 * 0.3));
}

TEST_CASE("joint names of common conventions become one name") {
  const std::map<std::string, std::string> known = {{"mixamorig:LeftUpLeg", "thigh_l"},
                                                    {"upperleg01.L", "thigh_l"},
                                                    {"thigh_l", "thigh_l"},
                                                    {"lThigh", "thigh_l"},
                                                    {"J_Bip_L_UpperLeg", "thigh_l"},
                                                    {"Bip01 L Thigh", "thigh_l"},
                                                    {"DEF-thigh.L", "thigh_l"},
                                                    {"CC_Base_L_Thigh", "thigh_l"},
                                                    {"UpperLeg.L", "thigh_l"},
                                                    {"LeftHip", "thigh_l"},
                                                    {"RightKnee", "calf_r"},
                                                    {"RightLeg", "calf_r"},
                                                    {"lowerleg01.R", "calf_r"},
                                                    {"calf_r", "calf_r"},
                                                    {"shin.R", "calf_r"},
                                                    {"LeftAnkle", "foot_l"},
                                                    {"LeftToeBase", "toes_l"},
                                                    {"ball_l", "toes_l"},
                                                    {"clavicle.L", "collar_l"},
                                                    {"LeftForeArm", "forearm_l"},
                                                    {"lowerarm01.L", "forearm_l"},
                                                    {"wrist.L", "hand_l"},
                                                    {"RightHandIndex1", "index_1_r"},
                                                    {"finger2-1.R", "index_1_r"},
                                                    {"index_01_r", "index_1_r"},
                                                    {"Hips", "hips"},
                                                    {"J_Bip_C_Hips", "hips"},
                                                    {"pelvis", "hips"},
                                                    {"Neck1", "neck"},
                                                    {"neck_01", "neck"},
                                                    {"Head", "head"},
                                                    {"pelvis.L", "pelvis.l"},
                                                    {"upperleg02.L", "upperleg02.l"},
                                                    {"LHipJoint", "lhipjoint"},
                                                    {"thigh_twist_01_l", "thigh_twist_01_l"},
                                                    {"Spine2", "spine2"}};
  for (const auto& [name, common] : known) {
    CAPTURE(name);
    CHECK(common_joint_name(name) == common);
  }
}
