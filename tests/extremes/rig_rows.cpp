// Rigs, clips and skinning: skeletons, weights and keys that no file should hold, and times of any kind.
#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/rig/retarget.hpp>
#include <bodice/rig/rig.hpp>
#include <bodice/rigging/motion.hpp>

#include "rows.hpp"

namespace extremes {
namespace {

using namespace bodice;
using geometry::Vec3;

constexpr double kLink_m = 0.1;

/// A chain of joints up the y axis, with one vertex bound to each.
rig::Rig chain(int joints) {
  rig::Rig rig;
  rig.weights.first.push_back(0);
  for (int j = 0; j < joints; ++j) {
    rig::Joint joint;
    joint.name = "j" + std::to_string(j);
    joint.parent = j - 1;
    if (j > 0) joint.local.translation = kLink_m * Vec3::UnitY();
    joint.bind.col(3) = kLink_m * j * Vec3::UnitY();
    rig.skeleton.joints.push_back(std::move(joint));
    rig.weights.joint.push_back(static_cast<std::uint16_t>(j));
    rig.weights.weight.push_back(1.0f);
    rig.weights.first.push_back(static_cast<std::uint32_t>(j + 1));
  }
  return rig;
}

/// A change of a rig of three joints, and whether it is refused.
struct RigChange {
  const char* name;
  bool refused;
  bool warned;
  void (*change)(rig::Rig&);
};
constexpr RigChange kRigChanges[] = {
    {"as it should be", false, false, [](rig::Rig&) {}},
    {"weights that sum to 2", false, true, [](rig::Rig& r) { r.weights.weight[1] = 2.0f; }},
    {"weights that sum to 1e-30", false, true, [](rig::Rig& r) { r.weights.weight[1] = 1e-30f; }},
    {"weights that sum to 3e38", false, true, [](rig::Rig& r) { r.weights.weight[1] = 3e38f; }},
    {"a vertex of weight zero", true, false, [](rig::Rig& r) { r.weights.weight[1] = 0.0f; }},
    {"a negative weight", true, false, [](rig::Rig& r) { r.weights.weight[1] = -1.0f; }},
    {"a weight that is no number", true, false,
     [](rig::Rig& r) { r.weights.weight[1] = std::numeric_limits<float>::quiet_NaN(); }},
    {"an infinite weight", true, false,
     [](rig::Rig& r) { r.weights.weight[1] = std::numeric_limits<float>::infinity(); }},
    {"a weight for a joint that is missing", true, false, [](rig::Rig& r) { r.weights.joint[1] = 60000; }},
    {"weights of another skin", true, false, [](rig::Rig& r) { r.weights.first.pop_back(); }},
    {"counts that fall", true, false, [](rig::Rig& r) { r.weights.first[1] = 3; }},
    {"a local transform that is no number", true, false,
     [](rig::Rig& r) { r.skeleton.joints[1].local.translation.x() = kNan; }},
    {"a rotation of length zero", true, false,
     [](rig::Rig& r) { r.skeleton.joints[1].local.rotation.coeffs().setZero(); }},
    {"a scale of zero", true, false, [](rig::Rig& r) { r.skeleton.joints[1].local.scale.y() = 0.0; }},
    {"a scale of 1e-6", false, false,
     [](rig::Rig& r) { r.skeleton.joints[1].local.scale.setConstant(1e-6); }},
    {"a scale of 1e6", false, false, [](rig::Rig& r) { r.skeleton.joints[1].local.scale.setConstant(1e6); }},
    {"a mirrored joint", false, false, [](rig::Rig& r) { r.skeleton.joints[1].local.scale.x() = -1.0; }},
    {"a bind matrix that shears", false, false, [](rig::Rig& r) { r.skeleton.joints[1].bind(0, 1) = 0.5; }},
    {"a bind matrix without an inverse", true, false,
     [](rig::Rig& r) { r.skeleton.joints[1].bind.col(2).setZero(); }},
    {"an infinite bind matrix", true, false, [](rig::Rig& r) { r.skeleton.joints[1].bind(0, 3) = kInf; }},
    {"a joint before its parent", true, false, [](rig::Rig& r) { r.skeleton.joints[0].parent = 2; }},
    {"a joint that is its own parent", true, false, [](rig::Rig& r) { r.skeleton.joints[1].parent = 1; }},
    {"a parent that is missing", true, false, [](rig::Rig& r) { r.skeleton.joints[1].parent = 7; }},
    {"a parent of -2", true, false, [](rig::Rig& r) { r.skeleton.joints[1].parent = -2; }},
};

/// The skin of a chain, 10 km away, posed by both kinds of skinning.
std::string check_skinning(const rig::Rig& rig, std::span<const rig::Affine> skinning, double most_m) {
  const std::size_t vertices = rig.weights.vertices();
  std::vector<Vec3> rest, linear(vertices), dual(vertices);
  for (std::size_t v = 0; v < vertices; ++v) rest.emplace_back(0.01, kLink_m * static_cast<double>(v), 0.0);
  rig::skin_linear(rest, rig.weights, skinning, linear);
  std::vector<rig::DualQuaternion> motion(skinning.size());
  rig::dual_quaternions(skinning, motion);
  rig::skin_dual_quaternion(rest, rig.weights, motion, dual);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (!linear[v].allFinite() || !(linear[v].norm() <= most_m)) return "linear skinning is out of bounds";
    if (!dual[v].allFinite() || !(dual[v].norm() <= most_m)) return "dual quaternions are out of bounds";
    // One joint moves each vertex, so that both kinds are the joint's own map.
    if (!((linear[v] - dual[v]).norm() <= 1e-6 * (1.0 + linear[v].norm()))) return "both kinds disagree";
  }
  return {};
}

std::string check_mend(const RigChange& change) {
  rig::Rig rig = chain(3);
  change.change(rig);
  const auto mended = rig::mend(rig, 3);
  if (change.refused) return check_refusal(mended);
  if (!mended.ok()) return "refused: " + mended.error().message;
  if (mended->empty() == change.warned) return change.warned ? "no warning" : "a warning";
  std::vector<rig::Affine> world(3), skinning(3);
  rig::rest_matrices(rig.skeleton, world);
  rig::skinning_matrices(rig.skeleton, world, skinning);
  return check_skinning(rig, skinning, 1e7);
}

std::string check_order(int joints, bool circle) {
  rig::Rig rig = chain(joints);
  std::ranges::reverse(rig.skeleton.joints);
  for (rig::Joint& joint : rig.skeleton.joints)
    if (joint.parent >= 0) joint.parent = joints - 1 - joint.parent;
  if (circle) rig.skeleton.joints.back().parent = 0;
  const auto ordered = rig::put_parents_first(rig);
  if (circle) return check_refusal(ordered);
  if (!ordered.ok()) return "refused: " + ordered.error().message;
  return expect(rig::validate(rig.skeleton).ok(), "a parent comes after its child");
}

/// Skinning matrices of a chain. Its middle joint moves by a map.
std::string check_map(const rig::Affine& map, int joints) {
  const rig::Rig rig = chain(joints);
  std::vector<rig::Affine> skinning(static_cast<std::size_t>(joints), rig::identity());
  if (joints > 0) skinning[static_cast<std::size_t>(joints / 2)] = map;
  const double most_m = 4.0 * (1.0 + map.cwiseAbs().maxCoeff()) * (1.0 + kLink_m * joints);
  return check_skinning(rig, skinning, most_m);
}

std::string check_rates(double dt_s) {
  const rig::Affine before = rig::identity(),
                    after = rig::affine(-geometry::Mat3::Identity(), Vec3(1e4, 0.0, 0.0));
  rig::Affine rate;
  rig::skinning_rates({&before, 1}, {&after, 1}, dt_s, {&rate, 1});
  if (!(dt_s > 0.0)) return expect(rate.isZero(), "a velocity without time");
  return expect(rate.allFinite() || dt_s < 1e-290, "not finite");
}

rig::Clip one_key(rig::Interpolation interpolation) {
  rig::Clip clip{.name = "one key", .duration_s = 0.0, .tracks = {rig::Track{.joint = 1}}};
  rig::Track& track = clip.tracks[0];
  const std::size_t values = interpolation == rig::Interpolation::kCubic ? 3 : 1;
  track.rotation = {interpolation, {0.5}, std::vector(values, rig::Quaternion(0.0, 0.0, 0.0, 1.0))};
  track.translation = {interpolation, {0.5}, std::vector<Vec3>(values, Vec3(0.0, 1.0, 0.0))};
  return clip;
}

/// Two linear keys half a turn apart: either great arc is a shorter one.
rig::Clip half_turn(double duration_s) {
  rig::Clip clip{.name = "half a turn", .duration_s = duration_s, .tracks = {rig::Track{.joint = 1}}};
  clip.tracks[0].rotation.time_s = {0.0, duration_s};
  clip.tracks[0].rotation.value = {Eigen::Quaterniond::Identity(), Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0)};
  return clip;
}

/// Plays a clip at times of any kind: joints stay rotations within reach.
std::string check_times(const rig::Clip& clip) {
  const rig::Rig rig = chain(3);
  if (const auto valid = rig::validate(clip, rig.skeleton); !valid.ok())
    return "refused: " + valid.error().message;
  std::vector<rig::Affine> world(3);
  for (const double time_s : {0.0, -0.0, 0.5, 1e-300, -1.0, 1e9, 1e308, kInf, -kInf, kNan})
    for (const auto playback : {rig::Playback::kClamp, rig::Playback::kLoop}) {
      rig::joint_matrices(rig.skeleton, clip, time_s, world, playback);
      for (const rig::Affine& map : world) {
        if (!map.allFinite() || !(map.col(3).norm() < 2.0)) return "a joint is out of bounds";
        const geometry::Mat3 turn = rig::linear_of(map);
        if (!((turn.transpose() * turn - geometry::Mat3::Identity()).norm() < 1e-9)) return "no rotation";
      }
    }
  return {};
}

std::string check_bad_keys(void (*change)(rig::Track&)) {
  rig::Clip clip = half_turn(1.0);
  change(clip.tracks[0]);
  return check_refusal(rig::validate(clip, chain(3).skeleton));
}

void add_skinning_rows(std::vector<Row>& rows) {
  const auto scaled = [](double s) { return rig::affine(s * geometry::Mat3::Identity(), Vec3::Zero()); };
  rig::Affine shear = rig::identity(), mirror = rig::identity(), flat = rig::identity(),
              far = rig::identity();
  shear(0, 1) = 3.0, mirror(0, 0) = -1.0, flat(2, 2) = 0.0, far(0, 3) = 1e4;
  const rig::Affine turned =
      rig::affine(Eigen::AngleAxisd(kHalfTurn_rad, Vec3::UnitX()).toRotationMatrix(), Vec3::Zero());
  for (const auto& [name, map] :
       {std::pair("shear", shear), std::pair("reflection", mirror), std::pair("flat", flat),
        std::pair("scale 1e-6", scaled(1e-6)), std::pair("scale 1e6", scaled(1e6)), std::pair("10 km", far),
        std::pair("half a turn", turned), std::pair("zero", scaled(0.0))})
    for (const int joints : {1, 3, 1000})
      rows.push_back({"skinning, linear and dual",
                      std::string(name) + ", " + std::to_string(joints) + " joints",
                      [=, map = map] { return check_map(map, joints); }});
  rows.push_back({"skinning, linear and dual", "no joint", [] { return check_map(rig::identity(), 0); }});
  for (const double dt_s : {0.0, -0.0, -1.0, 1e-300, 1.0 / 60.0, 1e300, kNan})
    rows.push_back(
        {"skinning_rates", "dt " + std::to_string(dt_s) + " s", [=] { return check_rates(dt_s); }});
}

void add_clip_rows(std::vector<Row>& rows) {
  for (const auto& [name, kind] :
       {std::pair("step", rig::Interpolation::kStep), std::pair("linear", rig::Interpolation::kLinear),
        std::pair("cubic", rig::Interpolation::kCubic)})
    rows.push_back({"joint_matrices", std::string("a clip of one key, ") + name,
                    [kind = kind] { return check_times(one_key(kind)); }});
  rows.push_back({"joint_matrices", "a clip without keys", [] { return check_times({}); }});
  for (const double s : {0.0, 1e-300, 1.0 / 60.0, 1e300})
    rows.push_back({"joint_matrices", "half a turn in " + std::to_string(s) + " s",
                    [=] { return check_times(half_turn(s)); }});
  for (const auto& [name, change] :
       {std::pair<const char*, void (*)(rig::Track&)>("a time that is no number",
                                                      [](rig::Track& t) { t.rotation.time_s[1] = kNan; }),
        {"times that fall", [](rig::Track& t) { t.rotation.time_s[0] = 2.0; }},
        {"a key that is infinite", [](rig::Track& t) { t.rotation.value[0].x() = kInf; }},
        {"a rotation of length zero", [](rig::Track& t) { t.rotation.value[0].coeffs().setZero(); }},
        {"a scale of zero",
         [](rig::Track& t) {
           t.scale = {rig::Interpolation::kStep, {0.0}, {Vec3::Zero()}};
         }},
        {"keys without values", [](rig::Track& t) { t.rotation.value.pop_back(); }},
        {"a joint that is missing", [](rig::Track& t) { t.joint = 9; }}})
    rows.push_back({"validate(clip)", name, [change = change] { return check_bad_keys(change); }});
}

void add_skeleton_rows(std::vector<Row>& rows) {
  for (const int joints : {0, 1, 1000, 65536}) {
    const std::string name = std::to_string(joints) + " joints of unknown names";
    if (joints == 65536) {
      rows.push_back(
          {"validate(skeleton)", name, [] { return check_refusal(rig::validate(chain(65536).skeleton)); }});
      continue;
    }
    rows.push_back(
        {"make_clip", name,
         [=] { return check_refusal(rigging::make_clip(chain(joints).skeleton, rigging::Motion::kWalk)); }});
    rows.push_back(
        {"retarget", name, [=] {
           const rig::Skeleton skeleton = chain(joints).skeleton;
           const auto carried = rig::retarget(skeleton, half_turn(1.0), skeleton);
           // A chain of the same names is a skeleton in common, however odd they are.
           return joints < 1000 ? check_refusal(carried) : carried.ok() ? "" : check_refusal(carried);
         }});
  }
}

}  // namespace

std::vector<Row> rig_rows() {
  std::vector<Row> rows;
  for (const RigChange& change : kRigChanges)
    rows.push_back({"rig::mend", change.name, [&change] { return check_mend(change); }});
  for (const int joints : {1, 3, 1000})
    for (const bool circle : {false, true})
      rows.push_back({"put_parents_first",
                      std::to_string(joints) + (circle ? " joints in a circle" : " joints, children first"),
                      [=] { return check_order(joints, circle); }});
  add_skinning_rows(rows);
  add_clip_rows(rows);
  add_skeleton_rows(rows);
  return rows;
}

}  // namespace extremes
