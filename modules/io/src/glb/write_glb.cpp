#include <array>

#include <Eigen/Geometry>

#include <bodice/engine/write_file.hpp>
#include <bodice/io/scene.hpp>

#include "../color.hpp"
#include "../scene_check.hpp"
#include "../unit_sphere.hpp"
#include "ellipsoid_keys.hpp"
#include "glb_builder.hpp"
#include "skin_writer.hpp"

namespace bodice::io {

namespace {

using geometry::Vec3;

constexpr int kSphereSplits = 3;  // 512 triangles, shared by all ellipsoids
constexpr float kEllipsoidAlpha = 0.55f;
constexpr std::array<float, 3> kSkin = {0.80f, 0.76f, 0.73f};
/// In units of the diagonal: farther from the origin the nodes carry the offset, so that floats keep their
/// digits.
constexpr double kFarDiagonals = 16.0;

class SceneWriter {
 public:
  explicit SceneWriter(const Scene& scene) : scene_(scene) {
    if (scene.rig) return;  // glTF skins are in meters, y up; the nodes of skinned meshes carry no offset
    frame_ = scene.frame;
    geometry::Box box;
    const geometry::Box inside = scene_box(scene);
    box.extend(scene.frame.to_file(inside.low));
    box.extend(scene.frame.to_file(inside.high));
    if (box.center().norm() > kFarDiagonals * box.size().norm()) origin_ = box.center().array().round();
  }

  std::string write() {
    animations_.emplace_back();
    animations_.back().name = "drape";
    if (scene_.body) add_body();
    if (scene_.proxy) add_ellipsoids();
    for (std::size_t k = 0; k < scene_.garments.size(); ++k) add_garment(scene_.garments[k], k);
    for (GlbAnimation& animation : animations_)
      if (!animation.channels.empty())
        glb_.add("animations", {{"name", animation.name},
                                {"samplers", std::move(animation.samplers)},
                                {"channels", std::move(animation.channels)}});
    return glb_.finish();
  }

 private:
  Vec3f to_file(const Vec3& inside) const { return (frame_.to_file(inside) - origin_).cast<float>(); }

  std::vector<Vec3f> to_file(std::span<const Vec3> points) const {
    std::vector<Vec3f> result;
    result.reserve(points.size());
    for (const Vec3& p : points) result.push_back(to_file(p));
    return result;
  }

  /// Unit normals in the file's axes; they point up where the mesh gives none, since glTF forbids zero.
  std::vector<Vec3f> normals_of(const geometry::TriMesh& mesh) const {
    std::vector<Vec3f> result;
    result.reserve(mesh.positions.size());
    for (const Vec3& n : vertex_normals(mesh)) {
      const Vec3 unit = n.squaredNorm() > 0.25 ? n : Vec3(Vec3::UnitY());
      result.push_back(frame_.direction_to_file(unit).cast<float>().normalized());
    }
    return result;
  }

  std::size_t add_material(const char* name, const Vec3f& color, float alpha, bool double_sided) {
    Json material = {{"name", name},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", {color.x(), color.y(), color.z(), alpha}},
                       {"metallicFactor", 0.0},
                       {"roughnessFactor", 0.85}}}};
    if (alpha < 1.0f) material["alphaMode"] = "BLEND";
    if (double_sided) material["doubleSided"] = true;
    return glb_.add("materials", std::move(material));
  }

  /// Adds a root node, translated by the offset that was subtracted from every position.
  std::size_t add_root(Json node) {
    if (!origin_.isZero()) node["translation"] = {origin_.x(), origin_.y(), origin_.z()};
    const std::size_t index = glb_.add("nodes", std::move(node));
    glb_.add_to_scene(index);
    return index;
  }

  void add_body() {
    const geometry::TriMesh& body = *scene_.body;
    Json attributes = {{"POSITION", glb_.add_positions(to_file(body.positions))},
                       {"NORMAL", glb_.add_vectors(normals_of(body))}};
    if (scene_.rig) add_skin_attributes(scene_.rig->weights, glb_, attributes);
    if (!scene_.part.empty()) {
      std::vector<Vec3f> colors;
      colors.reserve(scene_.part.size());
      for (const body::Part part : scene_.part) colors.push_back(to_linear(part_color(part)));
      attributes["COLOR_0"] = glb_.add_vectors(colors);
    }
    const Vec3f base = scene_.part.empty() ? to_linear(std::span(kSkin)) : Vec3f(Vec3f::Ones());
    const Json primitive = {{"attributes", attributes},
                            {"indices", glb_.add_triangles(body.triangles)},
                            {"material", add_material("skin", base, 1.0f, false)}};
    Json node = {{"name", "body"},
                 {"mesh", glb_.add("meshes", {{"name", "body"}, {"primitives", {primitive}}})}};
    if (scene_.rig) node["skin"] = add_rig();
    add_root(std::move(node));
  }

  /// Returns the skin. The first clip shares its animation with the garments.
  std::size_t add_rig() {
    const GlbSkeleton skeleton = add_skeleton(scene_.rig->skeleton, glb_);
    for (std::size_t k = 0; k < scene_.rig->clips.size(); ++k) {
      if (k > 0) animations_.emplace_back();
      animations_[k].name = scene_.rig->clips[k].name;
      add_clip(scene_.rig->clips[k], scene_.rig->skeleton, skeleton, glb_, animations_[k]);
    }
    return skeleton.skin;
  }

  /// Adds a node an ellipsoid. They share a mesh a part, and the meshes differ by material only.
  void add_ellipsoids() {
    const geometry::TriMesh sphere = unit_sphere(kSphereSplits);
    std::vector<Vec3f> points;
    for (const Vec3& p : sphere.positions) points.push_back(p.cast<float>());
    for (Vec3f& p : points) p.normalize();
    const Json attributes = {{"POSITION", glb_.add_positions(points)}, {"NORMAL", glb_.add_vectors(points)}};
    const std::size_t indices = glb_.add_triangles(sphere.triangles);
    std::array<std::size_t, body::kPartCount> mesh_of, count_of{};
    mesh_of.fill(kNone);
    Json children = Json::array();
    for (const proxy::ProxyEllipsoid& ellipsoid : scene_.proxy->ellipsoids()) {
      const auto part = static_cast<std::size_t>(ellipsoid.part);
      const std::string part_name(name(ellipsoid.part));
      if (mesh_of[part] == kNone) {
        const std::size_t material =
            add_material(part_name.c_str(), to_linear(part_color(ellipsoid.part)), kEllipsoidAlpha, false);
        const Json primitive = {{"attributes", attributes}, {"indices", indices}, {"material", material}};
        mesh_of[part] = glb_.add("meshes", {{"name", "ellipsoid_" + part_name}, {"primitives", {primitive}}});
      }
      Json node = placed(ellipsoid.shape);
      node["name"] = part_name + "_" + std::to_string(count_of[part]++);
      node["mesh"] = mesh_of[part];
      children.push_back(glb_.add("nodes", std::move(node)));
    }
    if (!scene_.proxy_frames.empty() && takes_time(scene_.garments.front())) animate_ellipsoids(children);
    Json root = {{"name", "ellipsoids"}};
    if (!children.empty()) root["children"] = std::move(children);
    add_root(std::move(root));
  }

  /// Adds keys of each ellipsoid's node at the times of the garments' frames.
  void animate_ellipsoids(const Json& nodes) {
    const std::size_t times = glb_.add_times(times_of(scene_.garments.front()));
    std::vector<geometry::Ellipsoid> shapes;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      shapes.clear();
      geometry::Mat3 before = in_file(scene_.proxy->ellipsoids()[k].shape).axes;
      for (const auto& frame : scene_.proxy_frames) {
        shapes.push_back(aligned(in_file(frame[k]), before));
        before = shapes.back().axes;
      }
      add_ellipsoid_keys(shapes, nodes[k].get<std::size_t>(), times, glb_, animations_.front());
    }
  }

  /// The ellipsoid in the unit and axes of the file, less the offset.
  geometry::Ellipsoid in_file(const geometry::Ellipsoid& shape) const {
    return {frame_.to_file(shape.center) - origin_, frame_.rotation().transpose() * shape.axes,
            shape.radii / frame_.meters_per_unit};
  }

  /// The translation, rotation and scale that turn the unit sphere into the ellipsoid.
  Json placed(const geometry::Ellipsoid& shape) const {
    const auto [center, axes, radii] = in_file(shape);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(axes).normalized();
    return {{"translation", {center.x(), center.y(), center.z()}},
            {"rotation", {turn.x(), turn.y(), turn.z(), turn.w()}},
            {"scale", {radii.x(), radii.y(), radii.z()}}};
  }

  void add_garment(const GarmentTrack& track, std::size_t k) {
    const std::vector<Vec3f> positions = to_file(track.mesh.positions), normals = normals_of(track.mesh);
    const std::array<float, 3> color = garment_color(k);
    Json attributes = {{"POSITION", glb_.add_positions(positions)}, {"NORMAL", glb_.add_vectors(normals)}};
    if (!track.colors.empty()) {
      std::vector<Vec3f> colors;
      for (const auto& srgb : track.colors) colors.push_back(to_linear(std::span(srgb)));
      attributes["COLOR_0"] = glb_.add_vectors(colors);
    }
    const Vec3f base = track.colors.empty() ? to_linear(std::span(color)) : Vec3f(Vec3f::Ones());
    Json primitive = {{"attributes", std::move(attributes)},
                      {"indices", glb_.add_triangles(track.mesh.triangles)},
                      {"material", add_material(track.name.c_str(), base, 1.0f, true)}};
    for (const auto& frame : track.frames)
      primitive["targets"].push_back(add_target(track.mesh.triangles, frame, positions, normals));
    Json mesh = {{"name", track.name}, {"primitives", {primitive}}};
    if (!track.frames.empty()) mesh["weights"] = std::vector<double>(track.frames.size(), 0.0);
    const std::size_t node = add_root({{"name", track.name}, {"mesh", glb_.add("meshes", std::move(mesh))}});
    if (takes_time(track)) animate(track, node);
  }

  /// Adds the displacements that turn the mesh into the frame.
  Json add_target(const std::vector<geometry::Triangle>& triangles, const std::vector<Vec3>& frame,
                  const std::vector<Vec3f>& positions, const std::vector<Vec3f>& normals) {
    std::vector<Vec3f> moved = to_file(frame), turned = normals_of({frame, triangles});
    for (std::size_t i = 0; i < moved.size(); ++i) {
      moved[i] -= positions[i];
      turned[i] -= normals[i];
    }
    return {{"POSITION", glb_.add_positions(moved)}, {"NORMAL", glb_.add_vectors(turned)}};
  }

  /// At each kept frame the weight of its target is one and all others are zero; between frames they are
  /// linear.
  void animate(const GarmentTrack& track, std::size_t node) {
    const std::size_t n = track.frames.size();
    std::vector<float> weights(n * n, 0.0f);
    for (std::size_t i = 0; i < n; ++i) weights[i * n + i] = 1.0f;
    const std::size_t input = glb_.add_times(times_of(track));
    animations_.front().add(node, "weights", input, glb_.add_scalars(weights), "LINEAR");
  }

  /// The times of a track's frames in the file: from 0, or with a rig those of its clip.
  std::vector<float> times_of(const GarmentTrack& track) const {
    std::vector<float> times(track.frames.size());
    const double begin = track.time_s.empty() || scene_.rig ? 0.0 : track.time_s[0];
    for (std::size_t i = 0; i < times.size(); ++i)
      times[i] =
          static_cast<float>(track.time_s.empty() ? static_cast<double>(i) / 30.0 : track.time_s[i] - begin);
    return times;
  }

  static constexpr std::size_t kNone = ~std::size_t{0};

  const Scene& scene_;
  geometry::Frame frame_;       // of the file
  Vec3 origin_ = Vec3::Zero();  // in file units
  GlbBuilder glb_;
  std::vector<GlbAnimation> animations_;  // the first has the garments
};

}  // namespace

engine::Result<void> write_glb(const Scene& scene, const std::filesystem::path& file) {
  if (auto checked = check_scene(scene); !checked) return checked;
  const std::string bytes = SceneWriter(scene).write();
  if (bytes.empty())
    return engine::Error{engine::ErrorCode::kWriteFailed,
                         "'" + file.string() + "' would be over the 4 GiB that a GLB can hold.",
                         "Keep fewer frames."};
  return engine::write_file(file, bytes);
}

}  // namespace bodice::io
