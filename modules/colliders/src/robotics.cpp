// MuJoCo and SDFormat: ellipsoids as they are, z up, meters, each under the body or link of its bone.
#include <cmath>

#include <bodice/engine/text.hpp>

#include "bone_frame.hpp"

namespace bodice::inline v0_1::colliders {
namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) engine::append_number(text += text.empty() ? "" : " ", tidy(value), 9);
  return text;
}

std::string numbers(const Vec3& v) {
  return numbers({v.x(), v.y(), v.z()});
}

/// The rotation from y up to z up.
Mat3 stand_up() {
  Mat3 turn;
  turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return turn;
}

/// A position and a turn without scale.
struct Pose {
  Mat3 turn = Mat3::Identity();
  Vec3 at = Vec3::Zero();
};

/// A bone in the world with z up. What has no bone stands in the world itself.
Pose pose_of(const BoneFrame& frame) {
  if (frame.name.empty()) return {};
  return {stand_up() * frame.turn(), stand_up() * frame.to_skin.col(3)};
}

Pose relative(const geometry::Ellipsoid& shape, const Pose& bone) {
  return {bone.turn.transpose() * stand_up() * shape.axes,
          bone.turn.transpose() * (stand_up() * shape.center - bone.at)};
}

std::string quaternion(const Mat3& turn) {
  const Eigen::Quaterniond q(turn);
  return numbers({q.w(), q.x(), q.y(), q.z()});
}

/// Roll, pitch and yaw: turns about x, then y, then z of the outer axes.
std::string roll_pitch_yaw(const Mat3& turn) {
  const double pitch = std::asin(std::clamp(-turn(2, 0), -1.0, 1.0));
  return numbers({std::atan2(turn(2, 1), turn(2, 2)), pitch, std::atan2(turn(1, 0), turn(0, 0))});
}

/// Text as an XML attribute.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// The name of a body or link: the joint's own.
std::string body_name(const BoneFrame& frame) {
  return frame.name.empty() ? "body" : escaped(frame.name);
}

}  // namespace

std::string mujoco_text(const proxy::BodyProxy& proxy) {
  std::string text = "<mujoco model=\"bodice " + engine::hex64(proxy.hash()) + "\">\n <worldbody>\n";
  for (const std::int16_t bone : bones_of(proxy.ellipsoids())) {
    const BoneFrame frame = frame_of(proxy, bone);
    const Pose pose = pose_of(frame);
    // Bodies that the simulation does not move: the host sets their poses as the joints move.
    text += "  <body name=\"" + body_name(frame) + "\" mocap=\"true\" pos=\"" + numbers(pose.at) +
            "\" quat=\"" + quaternion(pose.turn) + "\">\n";
    for (std::size_t i = 0; i < proxy.ellipsoids().size(); ++i) {
      const proxy::ProxyEllipsoid& e = proxy.ellipsoids()[i];
      if (e.bone != bone) continue;
      const Pose local = relative(e.shape, pose);
      text += "   <geom name=\"" + std::to_string(i) + "_" + std::string(body::name(e.part)) +
              "\" type=\"ellipsoid\" size=\"" + numbers(e.shape.radii) + "\" pos=\"" + numbers(local.at) +
              "\" quat=\"" + quaternion(local.turn) + "\"/>\n";
    }
    text += "  </body>\n";
  }
  return text + " </worldbody>\n</mujoco>\n";
}

std::string sdformat_text(const proxy::BodyProxy& proxy) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<sdf version=\"1.9\">\n <model name=\"body\">\n  <static>true</static>\n";
  for (const std::int16_t bone : bones_of(proxy.ellipsoids())) {
    const BoneFrame frame = frame_of(proxy, bone);
    const Pose pose = pose_of(frame);
    text += "  <link name=\"" + body_name(frame) + "\">\n   <pose>" + numbers(pose.at) + " " +
            roll_pitch_yaw(pose.turn) + "</pose>\n";
    for (std::size_t i = 0; i < proxy.ellipsoids().size(); ++i) {
      const proxy::ProxyEllipsoid& e = proxy.ellipsoids()[i];
      if (e.bone != bone) continue;
      const Pose local = relative(e.shape, pose);
      text += "   <collision name=\"" + std::to_string(i) + "_" + std::string(body::name(e.part)) +
              "\">\n    <pose>" + numbers(local.at) + " " + roll_pitch_yaw(local.turn) +
              "</pose>\n    <geometry><ellipsoid><radii>" + numbers(e.shape.radii) +
              "</radii></ellipsoid></geometry>\n   </collision>\n";
    }
    text += "  </link>\n";
  }
  return text + " </model>\n</sdf>\n";
}

}  // namespace bodice::colliders
