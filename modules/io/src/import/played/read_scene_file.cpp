#include <bodice/io/scene_file.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../color.hpp"
#include "../../look/look_mesh.hpp"
#include "import/played/node_tree.hpp"
#include "import/played/played_skin.hpp"
#include "import/source/check_gltf.hpp"
#include "import/source/input_file.hpp"

namespace bodice::inline v0_1::io {

namespace {

using engine::SortedJson;
using geometry::Vec3;

/// The part of a color, as write_glb() colors the skin.
body::Part part_colored(const Vec3& linear) {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int p = 0; p < body::kAllPartCount; ++p) {
    const Vec3 color = to_linear(part_color(static_cast<body::Part>(p))).cast<double>();
    const double apart = (color - linear).squaredNorm();
    if (apart < least) least = apart, best = p;
  }
  return static_cast<body::Part>(best);
}

/// Reads one document. Members return false where the file contradicts itself.
class SceneFileReader {
 public:
  SceneFileReader(const engine::Context& context, const GltfDocument& document)
      : context_(context), document_(document), tree_(document) {}

  bool read(SceneFile& out) { return read_garments(out) && read_body(out) && read_ellipsoids(out); }

 private:
  std::vector<Vec3> vectors(const SortedJson& object, const char* key) const {
    std::vector<Vec3> out;
    const auto at = index_at(object, key);
    const auto numbers = at ? document_.numbers(*at) : std::nullopt;
    if (!numbers || numbers->components < 3) return out;
    for (std::size_t i = 0; i < numbers->count; ++i) {
      const double* v = numbers->values.data() + i * numbers->components;
      out.emplace_back(v[0], v[1], v[2]);
    }
    return out;
  }

  const SortedJson& primitive_of(std::size_t node) const {
    static const SortedJson kNone;
    const auto mesh = index_at(document_.element("nodes", node), "mesh");
    const SortedJson& primitives =
        mesh ? array_at(document_.element("meshes", *mesh), "primitives") : array_at(kNone, "");
    return primitives.empty() ? kNone : primitives[0];
  }

  /// The node of a garment's mesh: that of its name, or the only one below it.
  std::size_t mesh_node(std::size_t node) const {
    const SortedJson& object = document_.element("nodes", node);
    const SortedJson& children = array_at(object, "children");
    if (index_at(object, "mesh") || children.size() != 1 || !children[0].is_number_unsigned()) return node;
    const auto child = children[0].get<std::size_t>();
    return child < tree_.size() ? child : node;
  }

  /// Adds the triangles of the mesh's further primitives, which share the vertices of the first one.
  bool read_other_triangles(std::size_t node, geometry::TriMesh& mesh) const {
    const auto at = index_at(document_.element("nodes", node), "mesh");
    if (!at) return true;
    const SortedJson& primitives = array_at(document_.element("meshes", *at), "primitives");
    for (std::size_t p = 1; p < primitives.size(); ++p)
      if (!read_triangles(primitives[p], mesh)) return false;
    return true;
  }

  /// Merges the vertices of a garment that stand for one vertex of the cloth. Cloths without the attribute
  /// have their own vertices.
  bool join_copies(const SortedJson& primitive, GarmentTrack& track) const {
    const auto at = index_at(primitive["attributes"], kClothVertex);
    if (!at) return true;
    const auto numbers = document_.numbers(*at);
    if (!numbers || numbers->components != 1 || numbers->count != track.mesh.positions.size()) return false;
    const auto count = static_cast<double>(numbers->count);
    std::vector<geometry::Index> cloth_vertex;
    for (const double v : numbers->values) {
      if (!(v >= 0.0 && v < count)) return false;
      cloth_vertex.push_back(static_cast<geometry::Index>(v));
    }
    const std::size_t vertices = std::size_t{1} + *std::ranges::max_element(cloth_vertex);
    const auto join = [&](std::vector<Vec3>& points) {
      std::vector<Vec3> joined(vertices, Vec3::Zero());
      for (std::size_t v = 0; v < points.size(); ++v) joined[cloth_vertex[v]] = points[v];
      points = std::move(joined);
    };
    join(track.mesh.positions);
    for (std::vector<Vec3>& frame : track.frames) join(frame);
    for (geometry::Triangle& triangle : track.mesh.triangles)
      for (geometry::Index& v : triangle) v = cloth_vertex[v];
    return true;
  }

  /// The mesh of a primitive in its own coordinates.
  bool read_mesh(const SortedJson& primitive, geometry::TriMesh& mesh) const {
    if (!primitive.is_object() || !primitive.contains("attributes")) return false;
    mesh.positions = vectors(primitive["attributes"], "POSITION");
    return !mesh.positions.empty() && read_triangles(primitive, mesh) &&
           std::ranges::all_of(mesh.positions, [](const Vec3& p) { return p.allFinite(); });
  }

  /// Appends the triangles of a primitive.
  bool read_triangles(const SortedJson& primitive, geometry::TriMesh& mesh) const {
    const auto at = index_at(primitive, "indices");
    const auto indices = at ? document_.numbers(*at) : std::nullopt;
    if (!indices || indices->components != 1 || indices->count % 3 != 0) return false;
    const auto vertices = static_cast<double>(mesh.positions.size());
    for (std::size_t i = 0; i < indices->count; i += 3) {
      geometry::Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(indices->values[i + k] < vertices)) return false;
        triangle[k] = static_cast<geometry::Index>(indices->values[i + k]);
      }
      mesh.triangles.push_back(triangle);
    }
    return true;
  }

  /// The times of the animation of a node's path, or none.
  std::vector<double> times_of(std::size_t node, const char* path) const {
    const SortedJson* sampler = sampler_of(node, path);
    const auto input = sampler ? index_at(*sampler, "input") : std::nullopt;
    const auto numbers = input ? document_.numbers(*input) : std::nullopt;
    return numbers ? numbers->values : std::vector<double>();
  }

  const SortedJson* sampler_of(std::size_t node, const char* path) const {
    const SortedJson& animation = document_.element("animations", 0);
    for (const SortedJson& channel : array_at(animation, "channels")) {
      if (!channel.contains("target") || index_at(channel["target"], "node") != node ||
          text_at(channel["target"], "path") != path)
        continue;
      const auto at = index_at(channel, "sampler");
      const SortedJson& samplers = array_at(animation, "samplers");
      return at && *at < samplers.size() ? &samplers[*at] : nullptr;
    }
    return nullptr;
  }

  bool read_garments(SceneFile& out) {
    for (int k = 1;; ++k) {
      const std::string name = k == 1 ? "cloth" : "cloth_" + std::to_string(k);
      const auto named = tree_.find_top(name);
      if (!named) return true;
      const std::size_t node = mesh_node(*named);
      GarmentTrack track;
      track.name = name;
      const SortedJson& primitive = primitive_of(node);
      if (!read_mesh(primitive, track.mesh) || !read_other_triangles(node, track.mesh)) return false;
      const Eigen::Affine3d to_world = tree_.world(node);
      for (const SortedJson& target : array_at(primitive, "targets")) {
        const std::vector<Vec3> moved = vectors(target, "POSITION");
        if (moved.size() != track.mesh.positions.size()) return false;
        std::vector<Vec3>& frame = track.frames.emplace_back();
        for (std::size_t v = 0; v < moved.size(); ++v)
          frame.push_back(to_world * Vec3(track.mesh.positions[v] + moved[v]));
      }
      for (Vec3& p : track.mesh.positions) p = to_world * p;
      for (const Vec3& color : vectors(primitive["attributes"], "COLOR_0"))
        track.colors.push_back(to_srgb(color));
      track.time_s = times_of(node, "weights");
      if (track.time_s.size() != track.frames.size()) track.time_s.assign(track.frames.size(), 0.0);
      if (!join_copies(primitive, track)) return false;
      out.garments.push_back(std::move(track));
    }
  }

  static std::array<float, 3> to_srgb(const Vec3& linear) {
    std::array<float, 3> color;
    for (int k = 0; k < 3; ++k) {
      const double v = std::clamp(linear[k], 0.0, 1.0);
      color[static_cast<std::size_t>(k)] =
          static_cast<float>(v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055);
    }
    return color;
  }

  bool read_body(SceneFile& out) {
    const auto node = tree_.find_top("body");
    if (!node) return true;
    const SortedJson& primitive = primitive_of(*node);
    if (!read_mesh(primitive, out.body)) return false;
    for (const Vec3& color : vectors(primitive["attributes"], "COLOR_0"))
      out.part.push_back(part_colored(color));
    if (!out.part.empty() && out.part.size() != out.body.positions.size()) return false;
    const SortedJson& body_node = document_.element("nodes", *node);
    if (body_node.contains("skin")) {
      if (out.garments.empty()) return true;
      const auto rig = played_rig(document_, tree_, body_node, out.body.positions.size());
      if (!rig) return false;
      out.body_frames = played_frames(context_, *rig, out.body.positions, out.garments.front().time_s);
      return true;
    }
    const Eigen::Affine3d to_world = tree_.world(*node);
    for (Vec3& p : out.body.positions) p = to_world * p;
    return true;
  }

  /// The unit sphere's image under a node: its linear map has orthogonal columns.
  static geometry::Ellipsoid ellipsoid_of(const Eigen::Affine3d& map) {
    geometry::Ellipsoid shape;
    shape.center = map.translation();
    for (int k = 0; k < 3; ++k) {
      shape.radii[k] = map.linear().col(k).norm();
      shape.axes.col(k) = map.linear().col(k) / shape.radii[k];
    }
    return shape;
  }

  bool read_ellipsoids(SceneFile& out) {
    const auto above = tree_.find_top("ellipsoids");
    if (!above) return true;
    const SortedJson& top = document_.element("nodes", *above);
    if (top.contains("extras")) {
      out.proxy_hash = text_at(top["extras"], "hash");
      out.tier = text_at(top["extras"], "tier");
    }
    std::vector<std::size_t> nodes;
    for (const SortedJson& child : array_at(top, "children")) {
      if (!child.is_number_unsigned() || child.get<std::size_t>() >= tree_.size()) return false;
      nodes.push_back(child.get<std::size_t>());
      const SortedJson& node = document_.element("nodes", nodes.back());
      const auto part = body::part_from_name(node.contains("extras") ? text_at(node["extras"], "part") : "");
      proxy::ProxyEllipsoid ellipsoid;
      ellipsoid.shape = ellipsoid_of(tree_.world(nodes.back()));
      ellipsoid.part = part.value_or(body::Part::kHead);
      if (!(ellipsoid.shape.radii.minCoeff() > 0.0) || !part) return false;
      out.ellipsoids.push_back(ellipsoid);
    }
    return read_moves(nodes, out);
  }

  /// Ellipsoids that move have a key of each kind at each kept frame.
  bool read_moves(const std::vector<std::size_t>& nodes, SceneFile& out) {
    if (nodes.empty() || !sampler_of(nodes[0], "translation") || out.garments.empty()) return true;
    out.ellipsoid_frames.resize(out.garments.front().frames.size());
    for (const std::size_t node : nodes) {
      std::vector<std::vector<double>> keys;
      for (const char* path : {"translation", "rotation", "scale"}) {
        const SortedJson* sampler = sampler_of(node, path);
        const auto output = sampler ? index_at(*sampler, "output") : std::nullopt;
        const auto numbers = output ? document_.numbers(*output) : std::nullopt;
        if (!numbers || numbers->count != out.ellipsoid_frames.size() ||
            numbers->components != (keys.size() == 1 ? 4u : 3u))
          return false;
        keys.push_back(numbers->values);
      }
      for (std::size_t f = 0; f < out.ellipsoid_frames.size(); ++f) {
        rig::LocalTransform local;
        local.translation = Eigen::Map<const Vec3>(keys[0].data() + 3 * f);
        local.rotation = Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(keys[1].data() + 4 * f));
        local.scale = Eigen::Map<const Vec3>(keys[2].data() + 3 * f);
        out.ellipsoid_frames[f].push_back(ellipsoid_of(tree_.world_with(node, local)));
      }
    }
    return true;
  }

  const engine::Context& context_;
  const GltfDocument& document_;
  NodeTree tree_;
};

}  // namespace

engine::Result<SceneFile> read_scene_file(const engine::Context& context, const std::filesystem::path& file) {
  if (auto checked = check_readable(file); !checked) return checked.error();
  const auto document = GltfDocument::open(file);
  const auto fail = [&](engine::ErrorCode code, const char* what) {
    return engine::Error{code, "'" + file.string() + "' " + what,
                         "Give a GLB that fit, drape or batch of bodice wrote."};
  };
  if (!document) return fail(engine::ErrorCode::kUnreadable, "is no glTF 2 file.");
  if (auto checked = check_gltf(*document, file); !checked) return checked.error();
  SceneFile out;
  if (!SceneFileReader(context, *document).read(out))
    return fail(engine::ErrorCode::kUnreadable, "is damaged: a mesh in it lacks some of its data.");
  if (out.body.empty() && out.ellipsoids.empty() && out.garments.empty())
    return fail(engine::ErrorCode::kInvalidArgument, "holds no body, ellipsoids or cloth of bodice.");
  return out;
}

}  // namespace bodice::io
