// Binding and posing: joint matrices that no bone should have, bodies of any size anywhere, and colliders
// that are posed over any time.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/Geometry>

#include <bodice/binding/bind.hpp>
#include <bodice/binding/poser.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/tryon/drape.hpp>

#include "rows.hpp"

namespace extremes {
namespace {

using namespace bodice;
using geometry::Mat3;
using geometry::Vec3;
using proxy::JointMatrix;

/// A body with a rig and its proxy, at a size and a distance from the origin.
struct Bound {
  synth::Body body;
  std::vector<Vec3> probes;  ///< near the skin
  proxy::BodyProxy unbound, proxy;

  static std::shared_ptr<const Bound> make(double scale, const Vec3& offset_m);
  std::vector<JointMatrix> bind_pose() const {
    std::vector<JointMatrix> pose;
    for (const rig::Joint& joint : body.skeleton.joints) pose.push_back(joint.bind);
    return pose;
  }
};

void put(synth::Body& body, double scale, const Vec3& offset_m) {
  for (Vec3& p : body.mesh.positions) p = scale * p + offset_m;
  for (rig::Joint& joint : body.skeleton.joints) joint.bind.col(3) = scale * joint.bind.col(3) + offset_m;
  body.stature_m *= scale;
}

std::shared_ptr<const Bound> Bound::make(double scale, const Vec3& offset_m) {
  synth::Body body = synth::make_body({}, {.vertices = 1500}).value();
  put(body, scale, offset_m);
  const auto fit = fitting::fit({}, {body.mesh, body.part, body.stature_m},
                                {.max_ellipsoids = 20, .measure_accuracy = false})
                       .value();
  const auto bound = binding::bind({}, fit.proxy, {body.mesh, body.skeleton, body.weights}).value();
  std::vector<Vec3> probes;
  const std::vector<Vec3> normals = geometry::vertex_normals(body.mesh);
  for (std::size_t v = 0; v < normals.size(); v += 11)
    probes.push_back(body.mesh.positions[v] + scale * 0.02 * (static_cast<double>(v % 3) - 1.0) * normals[v]);
  return std::make_shared<const Bound>(Bound{std::move(body), std::move(probes), fit.proxy, bound});
}

const Bound& at_home() {
  static const auto bound = Bound::make(1.0, Vec3::Zero());
  return *bound;
}

JointMatrix scaled(double by) {
  return rig::affine(by * Mat3::Identity(), Vec3::Zero());
}

std::vector<JointMatrix> moved(const JointMatrix& map, std::vector<JointMatrix> pose) {
  for (JointMatrix& joint : pose) joint = rig::compose(map, joint);
  return pose;
}

/// Ellipsoids are ellipsoids, and distances near the skin are finite and within a bound.
std::string check_posed(const binding::Poser& poser, std::span<const Vec3> points, double most_m) {
  for (const geometry::Ellipsoid& e : poser.posed().shapes) {
    if (!e.center.allFinite() || !e.axes.allFinite() || !e.radii.allFinite()) return "not finite";
    if (!(e.radii.minCoeff() > 0.0)) return "a radius of zero";
    if (!((e.axes.transpose() * e.axes - Mat3::Identity()).norm() < 1e-9))
      return "axes that are not orthonormal";
  }
  for (const Vec3& point : points) {
    const double d = proxy::posed_proxy_distance(poser.bound(), poser.posed(), point).distance;
    if (!(std::abs(d) <= most_m)) return "a distance of " + std::to_string(d) + " m";
  }
  return {};
}

/// Every joint moves by one map that is no shear: distances are those at rest, in the size of the pose.
std::string check_same_body(const Bound& bound, const JointMatrix& map, double scale) {
  auto poser = binding::Poser::make(bound.proxy);
  if (!poser.ok()) return "refused: " + poser.error().message;
  if (const auto done = poser->pose({}, bound.bind_pose()); !done.ok()) return done.error().message;
  std::vector<double> rest;
  for (const Vec3& p : bound.probes)
    rest.push_back(proxy::posed_proxy_distance(bound.proxy, poser->posed(), p).distance);
  if (const auto done = poser->pose({}, moved(map, bound.bind_pose())); !done.ok())
    return "refused: " + done.error().message;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const double now =
        proxy::posed_proxy_distance(bound.proxy, poser->posed(), rig::apply(map, bound.probes[i])).distance;
    // Half a step of a table of bytes, at the body's size.
    if (!(std::abs(now / scale - rest[i]) <= 2e-4 * bound.body.stature_m))
      return "a distance of " + std::to_string(now / scale) + " instead of " + std::to_string(rest[i]);
  }
  return {};
}

/// One matrix of a joint that moves skin is bad: the sentence names the joint, and the pose stays.
std::string check_bad_matrix(const JointMatrix& factor, bool all) {
  const Bound& bound = at_home();
  auto poser = binding::Poser::make(bound.proxy).value();
  std::vector<JointMatrix> pose = bound.bind_pose();
  if (const auto done = poser.pose({}, pose); !done.ok()) return done.error().message;
  const std::vector<geometry::Ellipsoid> before = poser.posed().shapes;
  const std::size_t calf = *rig::find_joint(bound.body.skeleton, "calf_l");
  for (std::size_t j = 0; j < pose.size(); ++j)
    if (all || j == calf) pose[j] = rig::compose(factor, pose[j]);
  const auto refused = poser.pose({}, pose);
  if (const std::string wrong = check_refusal(refused); !wrong.empty()) return wrong;
  if (!all && refused.error().message.find("'calf_l'") == std::string::npos) return "the joint is not named";
  for (std::size_t k = 0; k < before.size(); ++k)
    if (before[k].center != poser.posed().shapes[k].center) return "something moved";
  return {};
}

/// The pose in which some joints turn about their own origins, with all that they carry.
std::vector<JointMatrix> turned(const Bound& bound, std::initializer_list<const char*> joints,
                                double angle_rad) {
  std::vector<JointMatrix> maps, pose;
  for (const rig::Joint& joint : bound.body.skeleton.joints) {
    JointMatrix own = rig::identity();
    if (std::ranges::find(joints, joint.name) != joints.end()) {
      const Mat3 turn = Eigen::AngleAxisd(angle_rad, Vec3::UnitX()).toRotationMatrix();
      const Vec3 head = joint.bind.col(3);
      own = rig::affine(turn, head - turn * head);
    }
    maps.push_back(joint.parent < 0 ? own : rig::compose(maps[static_cast<std::size_t>(joint.parent)], own));
    pose.push_back(rig::compose(maps.back(), joint.bind));
  }
  return pose;
}

/// Joints turn by half a turn within one frame, and particles near the body are pushed out of it.
std::string check_half_turn(std::initializer_list<const char*> joints, double dt_s) {
  const Bound& bound = at_home();
  auto poser = binding::Poser::make(bound.proxy).value();
  collision::Collider collider(bound.proxy);
  if (const auto done = poser.pose({}, turned(bound, joints, kHalfTurn_rad)); !done.ok())
    return "refused: " + done.error().message;
  if (const std::string wrong = check_posed(poser, bound.probes, 3.0); !wrong.empty()) return wrong;
  if (!collider.pose(poser.posed(), dt_s)) return "the collider refuses the pose";
  std::vector<float> x[6];
  for (const Vec3& p : bound.probes)
    for (int axis = 0; axis < 3; ++axis) {
      x[axis].push_back(static_cast<float>((p - collider.origin())[axis]));
      x[3 + axis].push_back(0.0f);
    }
  const auto report = collider.resolve(
      {}, {x[0].size(), x[0].data(), x[1].data(), x[2].data(), x[3].data(), x[4].data(), x[5].data()}, {});
  if (report.unresolved != 0 || report.not_finite != 0) return "particles are left inside";
  const bool has_time = dt_s > 0.0;
  for (std::size_t i = 0; i < x[0].size(); ++i) {
    const Vec3 p(double{x[0][i]}, double{x[1][i]}, double{x[2][i]}),
        v(double{x[3][i]}, double{x[4][i]}, double{x[5][i]});
    if (!p.allFinite() || !v.allFinite() || !(p.norm() < 5.0)) return "a particle is out of bounds";
    if (!has_time && !v.isZero()) return "a velocity without time";
  }
  return {};
}

std::string check_bind_chain(int joints) {
  const Bound& bound = at_home();
  rig::Skeleton chain;
  rig::SkinWeights weights;
  for (int j = 0; j < joints; ++j) {
    rig::Joint joint;
    joint.name = "j" + std::to_string(j);
    joint.parent = j - 1;
    joint.bind.col(3) = Vec3(0.0, bound.body.stature_m * j / joints, 0.0);
    chain.joints.push_back(std::move(joint));
  }
  weights.first.push_back(0);
  for (const Vec3& p : bound.body.mesh.positions) {
    const double share = std::clamp(p.y() / bound.body.stature_m, 0.0, 0.9999);
    weights.joint.push_back(static_cast<std::uint16_t>(share * joints));
    weights.weight.push_back(1.0f);
    weights.first.push_back(static_cast<std::uint32_t>(weights.joint.size()));
  }
  const auto made = binding::bind({}, bound.unbound, {bound.body.mesh, chain, weights});
  if (joints == 0) return check_refusal(made);
  if (!made.ok()) return "refused: " + made.error().message;
  auto poser = binding::Poser::make(*made).value();
  std::vector<JointMatrix> pose;
  for (const rig::Joint& joint : chain.joints) pose.push_back(joint.bind);
  if (const auto done = poser.pose({}, pose); !done.ok()) return "refused: " + done.error().message;
  return check_posed(poser, bound.probes, 0.2);
}

/// A drape on a body that plays a clip of one key, or of no length.
std::string check_drape(double dt_s, std::vector<double> key_s) {
  const Bound& bound = at_home();
  tryon::PreparedBody body{.skin = {}, .fit = {.proxy = bound.proxy}};
  body.skin.input.skin = bound.body.mesh;
  body.skin.anatomy.part = bound.body.part;
  body.skin.anatomy.stature_m = bound.body.stature_m;
  body.skin.distance = std::make_shared<geometry::MeshDistance>(engine::Context{}, bound.body.mesh);
  body.skin.rig = std::make_shared<rig::Rig>(rig::Rig{bound.body.skeleton, bound.body.weights, {}});
  tryon::BodyMotion motion{.rig = *body.skin.rig, .clip = {}};
  rig::Track track{.joint = static_cast<std::uint16_t>(*rig::find_joint(bound.body.skeleton, "upper_arm_l"))};
  track.rotation.value.assign(key_s.size(), Eigen::Quaterniond::Identity());
  motion.clip = {.name = "one key", .duration_s = key_s.back(), .tracks = {}};
  track.rotation.time_s = std::move(key_s);
  motion.clip.tracks = {std::move(track)};
  geometry::TriMesh sheet{{{-0.2, 2.0, -0.2}, {0.2, 2.0, -0.2}, {-0.2, 2.0, 0.2}, {0.2, 2.0, 0.2}},
                          {{0, 2, 1}, {1, 2, 3}}};
  tryon::DrapeOptions options{.frames = 4, .dt_s = dt_s, .kept_frames = 2, .motion = &motion};
  options.solver.substeps = 4;
  const auto draped =
      tryon::drape({}, body, {{.name = "sheet", .mesh = std::move(sheet), .held = {}}}, options);
  if (!draped.ok()) return "refused: " + draped.error().message;
  return expect(draped->report.finite && draped->report.ramp_s <= 2.0, "not finite, or a ramp without end");
}

void add_matrix_rows(std::vector<Row>& rows) {
  JointMatrix shear = rig::identity(), mirror = rig::identity(), flat = rig::identity(),
              no_number = rig::identity(), infinite = rig::identity(), stretched = rig::identity();
  shear(0, 1) = 0.1, mirror(1, 1) = -1.0, flat(2, 2) = 1e-9, no_number(1, 2) = kNan, infinite(0, 3) = kInf;
  stretched(0, 0) = 2.0;
  for (const auto& [name, factor] :
       {std::pair("shear", shear), std::pair("reflection", mirror), std::pair("flat", flat),
        std::pair("NaN", no_number), std::pair("Inf", infinite),
        std::pair("a scale along one axis", stretched), std::pair("zero", scaled(0.0)),
        std::pair("scale 1e-7", scaled(1e-7)), std::pair("scale 1e7", scaled(1e7))})
    for (const bool all : {false, true})
      rows.push_back({"Poser::pose", std::string(name) + (all ? ", all joints" : ", one joint"),
                      [=, factor = factor] { return check_bad_matrix(factor, all); }});
  for (const double s : {1e-6, 1e-3, 0.5, 2.0, 1e3, 1e6})
    rows.push_back({"Poser::pose", "all joints at scale " + std::to_string(s),
                    [=] { return check_same_body(at_home(), scaled(s), s); }});
  const JointMatrix far = rig::affine(Eigen::AngleAxisd(1.0, Vec3(1.0, 2.0, 2.0) / 3.0).toRotationMatrix(),
                                      Vec3(6e3, -6.4e3, 4.8e3));
  rows.push_back({"Poser::pose", "10 km away", [=] { return check_same_body(at_home(), far, 1.0); }});
  const JointMatrix half =
      rig::affine(Eigen::AngleAxisd(kHalfTurn_rad, Vec3::UnitY()).toRotationMatrix(), Vec3::Zero());
  rows.push_back({"Poser::pose", "the whole body turned by 180 degrees",
                  [=] { return check_same_body(at_home(), half, 1.0); }});
}

}  // namespace

std::vector<Row> pose_rows() {
  std::vector<Row> rows;
  add_matrix_rows(rows);
  // Over less than a nanosecond, half a turn has a speed that no float holds.
  for (const auto& [name, dt_s] :
       {std::pair("1/60", 1.0 / 60.0), std::pair("1e-9", 1e-9), std::pair("0", 0.0), std::pair("-1", -1.0),
        std::pair("NaN", kNan), std::pair("Inf", kInf)})
    rows.push_back(
        {std::string("pose and resolve, dt ") + name + " s", "bones turned by 180 degrees", [dt_s = dt_s] {
           for (const auto& joints : {std::initializer_list<const char*>{"forearm_r"},
                                      std::initializer_list<const char*>{"calf_l", "neck", "hand_l"}})
             if (std::string wrong = check_half_turn(joints, dt_s); !wrong.empty()) return wrong;
           return std::string();
         }});
  for (const int joints : {0, 1, 1000})
    rows.push_back({"bind", std::to_string(joints) + " joints", [=] { return check_bind_chain(joints); }});
  for (const auto& [name, scale, offset_m] :
       {std::tuple("a body of a millimeter", 6e-4, Vec3(Vec3::Zero())),
        std::tuple("a body of a kilometer", 600.0, Vec3(Vec3::Zero())),
        std::tuple("a body bound 10 km from the origin", 1.0, Vec3(6e3, -6.4e3, 4.8e3))})
    rows.push_back({"bind and pose", name, [scale = scale, offset_m = offset_m] {
                      const JointMatrix turn =
                          rig::affine(Eigen::AngleAxisd(2.0, Vec3::UnitY()).toRotationMatrix(),
                                      scale * Vec3(1.0, 0.0, -2.0));
                      return check_same_body(*Bound::make(scale, offset_m), turn, 1.0);
                    }});
  for (const double dt_s : {0.0, 1.0 / 60.0, 1.0})
    for (const auto& [name, key_s] :
         {std::pair("one key", std::vector{0.0}), std::pair("one late key", std::vector{1e9}),
          std::pair("two keys at one time", std::vector{0.5, 0.5})})
      rows.push_back({"drape on a moving body, dt " + std::to_string(dt_s) + " s",
                      std::string("a clip of ") + name,
                      [=, key_s = key_s] { return check_drape(dt_s, key_s); }});
  return rows;
}

}  // namespace extremes
