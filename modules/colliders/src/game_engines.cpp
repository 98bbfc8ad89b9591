// Unity and Unreal: left-handed files, each shape in the coordinates of its bone.

#include <bodice/engine/json.hpp>
#include <bodice/engine/text.hpp>
#include <bodice/geometry/smallest_turn.hpp>

#include "bone_frame.hpp"

namespace bodice::inline v0_1::colliders {
namespace {

using engine::Json;

/// Importers of Unity negate x of everything, joints included.
Json unity_point(const Vec3& v) {
  return {{"x", tidy(-v.x())}, {"y", tidy(v.y())}, {"z", tidy(v.z())}};
}

/// Row after row, as Unity has the joint: mirrored on both sides.
Json unity_rest(const BoneFrame& frame) {
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      rows.push_back(tidy(((r == 0) != (c == 0) ? -1.0 : 1.0) * frame.to_skin(r, c)));
  return rows;
}

/// A point of the skin in an imported mesh, centimeters: y up becomes z up, mirrored.
Vec3 unreal_skin_point(const Vec3& v) {
  return 100.0 * Vec3(v.x(), v.z(), v.y());
}

/// A point in a joint's coordinates as importers of FBX have it; they negate y.
Vec3 unreal_point(const Vec3& v, const BoneFrame& frame) {
  return frame.name.empty() ? unreal_skin_point(v) : 100.0 * Vec3(v.x(), -v.y(), v.z());
}

Json unreal_vector(const Vec3& v) {
  return {{"X", tidy(v.x())}, {"Y", tidy(v.y())}, {"Z", tidy(v.z())}};
}

/// The shape at rest in the mesh's coordinates: importers of FBX and glTF agree there, and not in joints.
Json unreal_rest(const PlainShape& shape) {
  return {{"RestStart", unreal_vector(unreal_skin_point(shape.a))},
          {"RestEnd", unreal_vector(unreal_skin_point(shape.b))},
          {"RestRadius0", tidy(100.0 * shape.radius_a)},
          {"RestRadius1", tidy(100.0 * shape.radius_b)}};
}

/// Adds a shape to the lists of Unreal's FKAggregateGeom. The ball of Radius0 is at the end of +Z.
void add_unreal_shape(const PlainShape& at_rest, const BoneFrame& frame, Json& geometry) {
  const PlainShape local = in_bone(at_rest, frame);
  const Vec3 a = unreal_point(local.a, frame), b = unreal_point(local.b, frame);
  Json shape = {{"Center", unreal_vector(0.5 * (a + b))}};
  shape.update(unreal_rest(at_rest));
  if (is_sphere(local)) {
    shape["Radius"] = tidy(100.0 * local.radius_a);
    geometry["SphereElems"].push_back(std::move(shape));
    return;
  }
  const Eigen::Quaterniond turn = geometry::smallest_turn(Vec3::UnitZ(), a - b);
  shape["Rotation"] = {
      {"X", tidy(turn.x())}, {"Y", tidy(turn.y())}, {"Z", tidy(turn.z())}, {"W", tidy(turn.w())}};
  shape["Length"] = tidy((a - b).norm());
  if (local.radius_a == local.radius_b) {
    shape["Radius"] = tidy(100.0 * local.radius_a);
    geometry["SphylElems"].push_back(std::move(shape));
  } else {
    shape["Radius0"] = tidy(100.0 * local.radius_a), shape["Radius1"] = tidy(100.0 * local.radius_b);
    geometry["TaperedCapsuleElems"].push_back(std::move(shape));
  }
}

}  // namespace

std::string unity_text(const proxy::BodyProxy& proxy, std::span<const PlainShape> shapes) {
  Json file = {{"format", "bodice colliders for Unity"}, {"version", 1}};
  file["proxy"] = engine::hex64(proxy.hash());
  file["bones"] = Json::array();
  for (const std::int16_t bone : bones_of(shapes)) {
    const BoneFrame frame = frame_of(proxy, bone);
    if (!frame.name.empty()) file["bones"].push_back({{"name", frame.name}, {"rest", unity_rest(frame)}});
  }
  file["shapes"] = Json::array();
  for (const PlainShape& shape : shapes) {
    const BoneFrame frame = frame_of(proxy, shape.bone);
    const PlainShape local = in_bone(shape, frame);
    file["shapes"].push_back({{"bone", frame.name},
                              {"part", body::name(shape.part)},
                              {"a", unity_point(local.a)},
                              {"b", unity_point(local.b)},
                              {"radiusA", tidy(local.radius_a)},
                              {"radiusB", tidy(local.radius_b)}});
  }
  return file.dump({.indent = 1}) + "\n";
}

std::string unreal_text(const proxy::BodyProxy& proxy, std::span<const PlainShape> shapes) {
  Json file = {{"format", "bodice colliders for Unreal"}, {"version", 2}};
  file["proxy"] = engine::hex64(proxy.hash());
  file["SkeletalBodySetups"] = Json::array();
  for (const std::int16_t bone : bones_of(shapes)) {
    const BoneFrame frame = frame_of(proxy, bone);
    Json geometry = {{"SphereElems", Json::array()},
                     {"SphylElems", Json::array()},
                     {"TaperedCapsuleElems", Json::array()}};
    for (const PlainShape& shape : shapes)
      if (shape.bone == bone) add_unreal_shape(shape, frame, geometry);
    file["SkeletalBodySetups"].push_back({{"BoneName", frame.name}, {"AggGeom", std::move(geometry)}});
  }
  return file.dump({.indent = 1}) + "\n";
}

}  // namespace bodice::colliders
