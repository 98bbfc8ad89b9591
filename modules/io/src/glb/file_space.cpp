#include "file_space.hpp"

#include <Eigen/Geometry>

#include "../far_from_origin.hpp"
#include "../scene_check.hpp"

namespace bodice::inline v0_1::io {

namespace {

using geometry::Vec3;

constexpr const char* kAxisNames[] = {"x", "y", "z"};

}  // namespace

FileSpace::FileSpace(const Scene& scene) {
  if (scene.rig) return;  // the nodes of skinned meshes move nothing, so these are in meters, y up
  frame_ = scene.frame;
  geometry::Box box;
  const geometry::Box inside = scene_box(scene);
  box.extend(scene.frame.to_file(inside.low));
  box.extend(scene.frame.to_file(inside.high));
  if (is_far_from_origin(box)) origin_ = box.center().array().round();
}

std::vector<Vec3f> FileSpace::to_file(std::span<const Vec3> points) const {
  std::vector<Vec3f> result;
  result.reserve(points.size());
  for (const Vec3& p : points) result.push_back(to_file(p));
  return result;
}

std::vector<Vec3f> FileSpace::normals_of(const geometry::TriMesh& mesh) const {
  std::vector<Vec3f> result;
  result.reserve(mesh.positions.size());
  for (const Vec3& n : vertex_normals(mesh)) {
    const Vec3 unit = n.squaredNorm() > 0.25 ? n : Vec3(Vec3::UnitY());
    result.push_back(frame_.direction_to_file(unit).cast<float>().normalized());
  }
  return result;
}

geometry::Ellipsoid FileSpace::to_file(const geometry::Ellipsoid& shape) const {
  return {frame_.to_file(shape.center) - origin_, frame_.rotation().transpose() * shape.axes,
          shape.radii / frame_.meters_per_unit};
}

bool FileSpace::is_gltf() const {
  return frame_.meters_per_unit == 1.0 && frame_.up == geometry::Axis::kY;
}

std::size_t FileSpace::add_top_node(Json node, GlbBuilder& glb) {
  if (!origin_.isZero()) node["translation"] = {origin_.x(), origin_.y(), origin_.z()};
  const std::size_t index = glb.add("nodes", std::move(node));
  if (is_gltf())
    glb.add_to_scene(index);
  else
    top_nodes_.push_back(index);
  return index;
}

void FileSpace::add_root(GlbBuilder& glb) const {
  if (top_nodes_.empty()) return;
  const double scale = frame_.meters_per_unit;
  const Eigen::Quaterniond turn(frame_.rotation());
  Json root = {{"name", "input"}, {"children", top_nodes_}};
  if (frame_.up != geometry::Axis::kY) root["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
  if (scale != 1.0) root["scale"] = {scale, scale, scale};
  root["extras"] = {{"meters_per_unit", scale}, {"up", kAxisNames[static_cast<std::size_t>(frame_.up)]}};
  glb.add_to_scene(glb.add("nodes", std::move(root)));
}

std::size_t add_material(const char* name, const Vec3f& color, float alpha, bool double_sided,
                         GlbBuilder& glb) {
  Json material = {{"name", name},
                   {"pbrMetallicRoughness",
                    {{"baseColorFactor", {color.x(), color.y(), color.z(), alpha}},
                     {"metallicFactor", 0.0},
                     {"roughnessFactor", 0.85}}}};
  if (alpha < 1.0f) material["alphaMode"] = "BLEND";
  if (double_sided) material["doubleSided"] = true;
  return glb.add("materials", std::move(material));
}

}  // namespace bodice::io
