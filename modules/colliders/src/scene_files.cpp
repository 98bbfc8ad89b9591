// Godot and VRM: right-handed, y up, meters, as bodice itself.

#include <bodice/engine/json.hpp>
#include <bodice/engine/text.hpp>
#include <bodice/geometry/smallest_turn.hpp>

#include "bone_frame.hpp"

namespace bodice::inline v0_1::colliders {
namespace {

using engine::Json;

std::string number(double value) {
  std::string text;
  engine::append_number(text, tidy(value), 9);
  return text;
}

/// Row after row of the axes, then the origin, as Godot writes a Transform3D.
std::string godot_transform(const Mat3& axes, const Vec3& origin) {
  std::string text = "Transform3D(";
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) text += number(axes(r, c)) + ", ";
  return text + number(origin.x()) + ", " + number(origin.y()) + ", " + number(origin.z()) + ")";
}

/// Quotes a name as a Godot string.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// The resource of a shape, of which Godot's capsules have their height with both caps, along y.
std::string godot_resource(const PlainShape& local, std::size_t index) {
  const std::string id = " id=\"" + std::to_string(index + 1) + "\"]\n";
  const std::string radius = "radius = " + number(local.radius_a) + "\n";
  if (is_sphere(local)) return "[sub_resource type=\"SphereShape3D\"" + id + radius + "\n";
  return "[sub_resource type=\"CapsuleShape3D\"" + id + radius +
         "height = " + number((local.b - local.a).norm() + 2.0 * local.radius_a) + "\n\n";
}

std::string godot_shape_node(const PlainShape& local, std::size_t index, const std::string& parent) {
  const Mat3 axes = is_sphere(local)
                        ? Mat3(Mat3::Identity())
                        : geometry::smallest_turn(Vec3::UnitY(), local.b - local.a).toRotationMatrix();
  return "[node name=\"shape_" + std::to_string(index + 1) + "\" type=\"CollisionShape3D\" parent=\"" +
         parent + "\"]\ntransform = " + godot_transform(axes, 0.5 * (local.a + local.b)) +
         "\nshape = SubResource(\"" + std::to_string(index + 1) + "\")\n\n";
}

/// A glTF matrix is column after column.
Json columns(const proxy::JointMatrix& m) {
  Json values = Json::array();
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 3; ++r) values.push_back(m(r, c) + 0.0);
    values.push_back(c == 3 ? 1 : 0);
  }
  return values;
}

Json vrm_point(const Vec3& v) {
  return {tidy(v.x()), tidy(v.y()), tidy(v.z())};
}

Json vrm_shape(const PlainShape& local) {
  if (is_sphere(local))
    return {{"sphere", {{"offset", vrm_point(local.a)}, {"radius", tidy(local.radius_a)}}}};
  return {{"capsule",
           {{"offset", vrm_point(local.a)}, {"radius", tidy(local.radius_a)}, {"tail", vrm_point(local.b)}}}};
}

}  // namespace

std::string godot_text(const proxy::BodyProxy& proxy, std::span<const PlainShape> shapes) {
  std::string resources, nodes = "[node name=\"BodyColliders\" type=\"Node3D\"]\n\n";
  for (std::size_t i = 0; i < shapes.size(); ++i)
    resources += godot_resource(in_bone(shapes[i], frame_of(proxy, shapes[i].bone)), i);
  for (const std::int16_t bone : bones_of(shapes)) {
    const BoneFrame frame = frame_of(proxy, bone);
    std::string parent = "body";
    if (frame.name.empty()) {
      nodes += "[node name=\"body\" type=\"AnimatableBody3D\" parent=\".\"]\nsync_to_physics = false\n\n";
    } else {
      const std::string attachment = "bone_" + std::to_string(bone);
      nodes += "[node name=\"" + attachment + "\" type=\"BoneAttachment3D\" parent=\".\"]\ntransform = " +
               godot_transform(frame.to_skin.leftCols<3>(), frame.to_skin.col(3)) +
               "\nbone_name = " + quoted(frame.name) +
               "\nuse_external_skeleton = true\nexternal_skeleton = NodePath(\"../..\")\n\n";
      nodes += "[node name=\"body\" type=\"AnimatableBody3D\" parent=\"" + attachment +
               "\"]\nsync_to_physics = false\n\n";
      parent = attachment + "/body";
    }
    for (std::size_t i = 0; i < shapes.size(); ++i)
      if (shapes[i].bone == bone) nodes += godot_shape_node(in_bone(shapes[i], frame), i, parent);
  }
  return "[gd_scene load_steps=" + std::to_string(shapes.size() + 1) + " format=3]\n\n" + resources + nodes;
}

std::string vrm_text(const proxy::BodyProxy& proxy, std::span<const PlainShape> shapes) {
  Json file = {{"asset", {{"version", "2.0"}, {"generator", "bodice"}}}, {"scene", 0}};
  Json roots = Json::array(), nodes = Json::array(), colliders = Json::array(), members = Json::array();
  const std::vector<std::int16_t> bones = bones_of(shapes);
  for (const std::int16_t bone : bones) {
    const BoneFrame frame = frame_of(proxy, bone);
    roots.push_back(nodes.size());
    nodes.push_back({{"name", frame.name}, {"matrix", columns(frame.to_skin)}});
  }
  for (const PlainShape& shape : shapes) {
    const auto node = std::ranges::lower_bound(bones, shape.bone) - bones.begin();
    members.push_back(colliders.size());
    colliders.push_back({{"node", node}, {"shape", vrm_shape(in_bone(shape, frame_of(proxy, shape.bone)))}});
  }
  file["scenes"] = Json::array({Json{{"nodes", roots}}});
  file["nodes"] = nodes;
  file["extensionsUsed"] = {"VRMC_springBone"};
  file["extensions"]["VRMC_springBone"] = {
      {"specVersion", "1.0"},
      {"colliders", colliders},
      {"colliderGroups", Json::array({Json{{"name", "body"}, {"colliders", members}}})}};
  return file.dump({.indent = 1}) + "\n";
}

}  // namespace bodice::colliders
