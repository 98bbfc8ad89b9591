#include <array>

#include <Eigen/Geometry>

#include <bodice/engine/text.hpp>
#include <bodice/engine/write_file.hpp>
#include <bodice/io/scene.hpp>

#include "../color.hpp"
#include "../scene_check.hpp"
#include "../unit_sphere.hpp"
#include "ellipsoid_keys.hpp"
#include "file_space.hpp"
#include "garment_writer.hpp"
#include "glb_builder.hpp"
#include "skin_writer.hpp"

namespace bodice::inline v0_1::io {

namespace {

using geometry::Vec3;

constexpr int kSphereSplits = 3;  // 512 triangles, shared by all ellipsoids
constexpr float kEllipsoidAlpha = 0.55f;
constexpr std::array<float, 3> kPlainSkin = {0.80f, 0.76f, 0.73f};
class SceneWriter {
 public:
  explicit SceneWriter(const Scene& scene) : scene_(scene), space_(scene) {}

  std::string write() {
    animations_.emplace_back();
    animations_.back().name = "drape";
    if (scene_.body) add_body();
    for (const StillThing& thing : scene_.things) add_thing(thing);
    if (scene_.proxy) add_ellipsoids();
    for (std::size_t k = 0; k < scene_.garments.size(); ++k)
      add_garment(scene_, k, space_, glb_, animations_.front());
    space_.add_root(glb_);
    for (GlbAnimation& animation : animations_)
      if (!animation.channels.empty())
        glb_.add("animations", {{"name", animation.name},
                                {"samplers", std::move(animation.samplers)},
                                {"channels", std::move(animation.channels)}});
    return glb_.finish();
  }

 private:
  void add_body() {
    const geometry::TriMesh& body = *scene_.body;
    Json attributes = {{"POSITION", glb_.add_positions(space_.to_file(body.positions))},
                       {"NORMAL", glb_.add_vectors(space_.normals_of(body))}};
    if (scene_.rig) add_skin_attributes(scene_.rig->weights, glb_, attributes);
    Json node = painted("body", "skin", body, scene_.part, std::move(attributes));
    if (scene_.rig) node["skin"] = add_rig();
    space_.add_top_node(std::move(node), glb_);
  }

  void add_thing(const StillThing& thing) {
    Json attributes = {{"POSITION", glb_.add_positions(space_.to_file(thing.mesh->positions))},
                       {"NORMAL", glb_.add_vectors(space_.normals_of(*thing.mesh))}};
    space_.add_top_node(painted(thing.name, "thing", *thing.mesh, thing.part, std::move(attributes)), glb_);
  }

  /// A node with a mesh in the colors of its parts, if it has any.
  Json painted(const std::string& name, const char* material, const geometry::TriMesh& mesh,
               std::span<const body::Part> part, Json attributes) {
    if (!part.empty()) {
      std::vector<Vec3f> colors;
      colors.reserve(part.size());
      for (const body::Part each : part) colors.push_back(to_linear(part_color(each)));
      attributes["COLOR_0"] = glb_.add_vectors(colors);
    }
    const Vec3f base = part.empty() ? to_linear(std::span(kPlainSkin)) : Vec3f(Vec3f::Ones());
    const Json primitive = {{"attributes", attributes},
                            {"indices", glb_.add_triangles(mesh.triangles)},
                            {"material", add_material(material, base, 1.0f, false, glb_)}};
    return {{"name", name}, {"mesh", glb_.add("meshes", {{"name", name}, {"primitives", {primitive}}})}};
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
    std::array<std::size_t, body::kAllPartCount> mesh_of, count_of{};
    mesh_of.fill(kNone);
    Json children = Json::array();
    for (std::size_t k = 0; k < scene_.proxy->ellipsoids().size(); ++k) {
      const proxy::ProxyEllipsoid& ellipsoid = scene_.proxy->ellipsoids()[k];
      const auto part = static_cast<std::size_t>(ellipsoid.part);
      const std::string part_name(name(ellipsoid.part));
      if (mesh_of[part] == kNone) {
        const std::size_t material = add_material(part_name.c_str(), to_linear(part_color(ellipsoid.part)),
                                                  kEllipsoidAlpha, false, glb_);
        const Json primitive = {{"attributes", attributes}, {"indices", indices}, {"material", material}};
        mesh_of[part] = glb_.add("meshes", {{"name", "ellipsoid_" + part_name}, {"primitives", {primitive}}});
      }
      Json node = placed(ellipsoid.shape);
      node["name"] = part_name + "_" + std::to_string(count_of[part]++);
      node["mesh"] = mesh_of[part];
      node["extras"] = extras_of(k);
      children.push_back(glb_.add("nodes", std::move(node)));
    }
    if (!scene_.proxy_frames.empty() && takes_time(scene_.garments.front())) animate_ellipsoids(children);
    Json root = {{"name", "ellipsoids"}, {"extras", extras_of_proxy()}};
    if (!children.empty()) root["children"] = std::move(children);
    space_.add_top_node(std::move(root), glb_);
  }

  Json extras_of_proxy() const {
    const proxy::BodyProxy& proxy = *scene_.proxy;
    return {{"hash", engine::hex64(proxy.hash())},
            {"tier", proxy::name(proxy.tier())},
            {"stature_m", proxy.stature_m()}};
  }

  Json extras_of(std::size_t k) const {
    const proxy::ProxyEllipsoid& ellipsoid = scene_.proxy->ellipsoids()[k];
    Json extras = {{"index", k}, {"part", name(ellipsoid.part)}};
    if (const proxy::Binding* binding = scene_.proxy->binding(); binding && ellipsoid.bone != proxy::kNoBone)
      extras["bone"] = binding->joint_names[static_cast<std::size_t>(ellipsoid.bone)];
    extras["hash"] = engine::hex64(scene_.proxy->hash());
    return extras;
  }

  /// Adds keys of each ellipsoid's node at the times of the garments' frames.
  void animate_ellipsoids(const Json& nodes) {
    const std::size_t times = glb_.add_times(times_of(scene_.garments.front(), scene_.rig != nullptr));
    std::vector<geometry::Ellipsoid> shapes;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      shapes.clear();
      geometry::Mat3 before = space_.to_file(scene_.proxy->ellipsoids()[k].shape).axes;
      for (const auto& frame : scene_.proxy_frames) {
        shapes.push_back(aligned(space_.to_file(frame[k]), before));
        before = shapes.back().axes;
      }
      add_ellipsoid_keys(shapes, nodes[k].get<std::size_t>(), times, glb_, animations_.front());
    }
  }

  /// The translation, rotation and scale that turn the unit sphere into the ellipsoid.
  Json placed(const geometry::Ellipsoid& shape) const {
    const auto [center, axes, radii] = space_.to_file(shape);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(axes).normalized();
    return {{"translation", {center.x(), center.y(), center.z()}},
            {"rotation", {turn.x(), turn.y(), turn.z(), turn.w()}},
            {"scale", {radii.x(), radii.y(), radii.z()}}};
  }

  static constexpr std::size_t kNone = ~std::size_t{0};

  const Scene& scene_;
  FileSpace space_;
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
