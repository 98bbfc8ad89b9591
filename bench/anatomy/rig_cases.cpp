#include "rig_cases.hpp"

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "cases.hpp"
#include "read_mesh.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;
using bodice::engine::Random;
using bodice::geometry::Vec3;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using nlohmann::json;

constexpr double kDegree = M_PI / 180.0;

double near_zero(Random& random, double deviation, double most) {
  return std::clamp(deviation * random.normal(), -most, most);
}

/// Random turns of all joints up to the limits of sport and sleep, independent for each limb.
Turns random_turns(Random& random) {
  Turns turns;
  for (const char* bone : {"spine04", "spine02", "neck01", "head"})
    turns[bone] =
        turn(4.0 + near_zero(random, 9.0, 20.0), near_zero(random, 8.0, 20.0), near_zero(random, 6.0, 15.0));
  for (const char* side : {".L", ".R"}) {
    const auto limb = [&](const std::string& bone, const Quaterniond& left) {
      turns[bone + side] = side[1] == 'L' ? left : mirrored(left);
    };
    limb("upperleg01",
         turn(random.uniform(-110.0, 25.0), near_zero(random, 12.0, 25.0), random.uniform(-8.0, 35.0)));
    limb("lowerleg01", turn(random.uniform(0.0, 125.0), 0.0, 0.0));
    limb("foot", turn(random.uniform(-15.0, 35.0), 0.0, 0.0));
    limb("upperarm01", turn(0.0, random.uniform(-80.0, 20.0), random.uniform(-30.0, 100.0)));
    limb("lowerarm01", turn(0.0, random.uniform(-115.0, 0.0), 0.0));
  }
  return turns;
}

std::map<std::string, std::size_t> landmark_vertices(const json& truth) {
  std::map<std::string, std::size_t> vertex;
  const json& v = truth["landmark_vertices"];
  vertex["crown"] = v["head_top"];
  vertex["perineum"] = v["crotch"];
  for (const std::string side : {"l", "r"}) {
    vertex["fingertip_" + side] = v[side + "_fingertip"];
    vertex["toe_" + side] = v[side + "_toe_tip"];
    vertex["armpit_" + side] = v[side + "_armpit"];
  }
  return vertex;
}

const std::map<std::string, std::string>& joint_landmarks() {
  static const std::map<std::string, std::string> bone_of{{"neck", "neck01"},
                                                          {"elbow_l", "lowerarm01.L"},
                                                          {"elbow_r", "lowerarm01.R"},
                                                          {"knee_l", "lowerleg01.L"},
                                                          {"knee_r", "lowerleg01.R"}};
  return bone_of;
}

/// The bones that begin where the joints of body::JointId do.
const std::map<std::string, std::string>& joint_bones() {
  static const std::map<std::string, std::string> bone_of{{"pelvis", "root"},
                                                          {"spine_lower", "spine03"},
                                                          {"spine_middle", "spine02"},
                                                          {"spine_upper", "spine01"},
                                                          {"neck", "neck01"},
                                                          {"head", "head"},
                                                          {"clavicle_l", "clavicle.L"},
                                                          {"clavicle_r", "clavicle.R"},
                                                          {"upper_arm_l", "upperarm01.L"},
                                                          {"upper_arm_r", "upperarm01.R"},
                                                          {"thigh_l", "upperleg01.L"},
                                                          {"thigh_r", "upperleg01.R"}};
  return bone_of;
}

}  // namespace

Quaterniond turn(double x_deg, double y_deg, double z_deg) {
  return AngleAxisd(z_deg * kDegree, Vec3::UnitZ()) * AngleAxisd(y_deg * kDegree, Vec3::UnitY()) *
         AngleAxisd(x_deg * kDegree, Vec3::UnitX());
}

Quaterniond mirrored(const Quaterniond& left) {
  return {left.w(), left.x(), -left.y(), -left.z()};
}

std::vector<RiggedBody> rigged_bodies(const fs::path& data) {
  std::map<char, Rig> rig_of_sex{{'f', read_rig(data / "rigs" / "f_avg_walk.glb")},
                                 {'m', read_rig(data / "rigs" / "m_avg_reach.glb")}};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(data / "bodies"))
    if (entry.path().filename().string().ends_with("_rest.obj")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<RiggedBody> bodies;
  for (const fs::path& file : files) {
    std::ifstream in(fs::path(file).replace_extension(".json"));
    const json truth = json::parse(in);
    const std::string stem = file.stem().string();
    bodies.push_back({stem.substr(0, stem.size() - std::string("_rest").size()),
                      moved_into(rig_of_sex.at(stem[0]), read_mesh(file)), landmark_vertices(truth),
                      truth["stature_rest_m"]});
  }
  return bodies;
}

PosedBody pose(const RiggedBody& body, const Turns& turns_of) {
  std::vector<Quaterniond> turns(body.rig.bones.size(), Quaterniond::Identity());
  std::map<std::string, std::size_t> bone;
  for (std::size_t b = 0; b < turns.size(); ++b) {
    bone[body.rig.bones[b].name] = b;
    if (const auto found = turns_of.find(body.rig.bones[b].name); found != turns_of.end())
      turns[b] = found->second;
  }
  const auto moved = pose_bones(body.rig, turns);
  const auto head = [&](const std::string& name) {
    const std::size_t b = bone.at(name);
    return Vec3(moved[b] * body.rig.bones[b].head);
  };
  PosedBody posed{pose_skin(body.rig, moved), {}, {}};
  for (const auto& [name, vertex] : body.landmark_vertex)
    posed.landmarks[name] = posed.skin.positions[vertex];
  for (const auto& [name, of] : joint_landmarks()) posed.landmarks[name] = head(of);
  for (const auto& [name, of] : joint_bones()) posed.joints[name] = head(of);
  return posed;
}

std::vector<Case> rig_cases(const fs::path& data, std::uint64_t from, std::uint64_t count) {
  const std::vector<RiggedBody> bodies = rigged_bodies(data);
  const std::vector<int> labels = body_labels(data);
  std::vector<Case> cases;
  for (std::uint64_t seed = from; seed < from + count && !bodies.empty(); ++seed) {
    const RiggedBody& body = bodies[seed % bodies.size()];
    Random random(seed);
    PosedBody posed = pose(body, random_turns(random));
    cases.push_back({"rig/" + std::to_string(seed) + " " + body.name, std::move(posed.skin), labels,
                     std::move(posed.landmarks), body.stature});
    cases.back().kind = body.name;
    cases.back().joints = std::move(posed.joints);
  }
  return cases;
}

}  // namespace bench
