#include "garment_writer.hpp"

#include <array>
#include <optional>

#include <bodice/engine/text.hpp>

#include "../color.hpp"
#include "../look/look.hpp"
#include "../look/look_mesh.hpp"
#include "../scene_check.hpp"
#include "look_writer.hpp"
#include "morph_targets.hpp"

namespace bodice::inline v0_1::io {

namespace {

/// The targets of all frames, and by how much the mesh's node must be scaled for them.
struct Targets {
  Json list = Json::array();
  float scale = 1.0f;
};

void divide(std::vector<Vec3f>& points, float scale) {
  for (Vec3f& p : points) p /= scale;  // a power of two: no digit is lost
}

/// The cloth's frames with the vertices that the file needs.
class Frames {
 public:
  Frames(const GarmentTrack& track, const FileSpace& space, const std::optional<LookMesh>& look)
      : track_(track), space_(space), look_(look) {}

  std::size_t count() const { return track_.frames.size(); }
  FrameShape base() const {
    return {spread(space_.to_file(track_.mesh.positions)), spread(space_.normals_of(track_.mesh))};
  }
  std::vector<Vec3f> positions(std::size_t f) const { return spread(space_.to_file(track_.frames[f])); }
  /// Normals are those of the cloth, so that it is smooth across seams of a texture.
  FrameShape shape(std::size_t f) const {
    return {positions(f), spread(space_.normals_of({track_.frames[f], track_.mesh.triangles}))};
  }

 private:
  std::vector<Vec3f> spread(std::vector<Vec3f> of_cloth) const {
    return look_ ? look_->spread(of_cloth) : of_cloth;
  }

  const GarmentTrack& track_;
  const FileSpace& space_;
  const std::optional<LookMesh>& look_;
};

/// Divides the base's positions by the scale.
Targets add_targets(const Frames& frames, FrameShape& base, GlbBuilder& glb) {
  Targets targets;
  const std::size_t count = frames.count(), vertices = base.positions.size();
  const auto shape = [&](std::size_t f) {
    FrameShape at = frames.shape(f);
    if (targets.scale != 1.0f) divide(at.positions, targets.scale);
    return at;
  };
  if (2 * sizeof(Vec3f) * vertices * count <= kMostFloatTargetBytes) {
    targets.list = add_float_targets(base, count, shape, glb);
    return targets;
  }
  targets.scale =
      displacement_scale(base.positions, count, [&](std::size_t f) { return frames.positions(f); });
  divide(base.positions, targets.scale);
  targets.list = add_quantized_targets(base, count, shape, glb);
  return targets;
}

Json target_names(const std::vector<float>& times) {
  Json names = Json::array();
  for (const float time : times) {
    std::string name;
    engine::append_number(name, static_cast<double>(time), 4);
    names.push_back(name + " s");
  }
  return names;
}

/// Weights of `n` frames: the square of n numbers, of which n are ones. Where that would take much, the ones
/// alone are stored.
std::size_t add_frame_weights(std::size_t n, GlbBuilder& glb) {
  constexpr std::size_t kMostDense = 128;
  std::vector<std::uint32_t> ones;
  for (std::size_t i = 0; i < n; ++i) ones.push_back(static_cast<std::uint32_t>(i * n + i));
  if (n > kMostDense) return glb.add_ones(ones, n * n);
  std::vector<float> weights(n * n, 0.0f);
  for (const std::uint32_t at : ones) weights[at] = 1.0f;
  return glb.add_scalars(weights);
}

/// At each kept frame the weight of its target is one and all others are zero; between frames they are
/// linear.
void animate(const std::vector<float>& times, std::size_t node, GlbBuilder& glb, GlbAnimation& animation) {
  const std::size_t input = glb.add_times(times);
  animation.add(node, "weights", input, add_frame_weights(times.size(), glb), "LINEAR");
}

/// The name that its file gives the garment, if it does.
const std::string& name_of(const GarmentTrack& track) {
  return track.look && !track.look->name.empty() ? track.look->name : track.name;
}

/// Adds the mesh's node: `cloth` itself, or below it under the name that the garment's file gives.
std::size_t add_nodes(const GarmentTrack& track, Json node, FileSpace& space, GlbBuilder& glb) {
  if (name_of(track) == track.name) return space.add_top_node(std::move(node), glb);
  const std::size_t index = glb.add("nodes", std::move(node));
  space.add_top_node({{"name", track.name}, {"children", {index}}}, glb);
  return index;
}

void add_colors(const GarmentTrack& track, Json& attributes, GlbBuilder& glb) {
  if (track.colors.empty()) return;
  std::vector<Vec3f> colors;
  for (const auto& srgb : track.colors) colors.push_back(to_linear(std::span(srgb)));
  attributes["COLOR_0"] = glb.add_vectors(colors);
}

/// Adds texture coordinates, and the cloth's vertex of each vertex where they are not the same.
void add_look_attributes(const LookMesh& look, std::size_t cloth_vertices, Json& attributes,
                         GlbBuilder& glb) {
  for (std::size_t set = 0; set < look.uv.size(); ++set)
    attributes["TEXCOORD_" + std::to_string(set)] = glb.add_attribute(look.uv[set], "VEC2");
  if (look.is_cloth(cloth_vertices)) return;
  const std::vector<float> numbers(look.cloth_vertex.begin(), look.cloth_vertex.end());
  attributes[kClothVertex] = glb.add_attribute(numbers, "SCALAR");
}

std::size_t plain_material(const GarmentTrack& track, std::size_t k, GlbBuilder& glb) {
  const std::array<float, 3> color = garment_color(k);
  const Vec3f tint = track.colors.empty() ? to_linear(std::span(color)) : Vec3f(Vec3f::Ones());
  return add_material(track.name.c_str(), tint, 1.0f, true, glb);
}

Json primitive_of(const Json& attributes, std::span<const geometry::Triangle> triangles, std::size_t material,
                  GlbBuilder& glb) {
  return {{"attributes", attributes}, {"indices", glb.add_triangles(triangles)}, {"material", material}};
}

/// A primitive a material; all share their vertices.
Json look_primitives(const GarmentTrack& track, std::size_t k, const LookMesh& look, const Json& attributes,
                     GlbBuilder& glb) {
  const std::vector<std::size_t> materials = add_materials(track.look->materials, glb);
  Json primitives = Json::array();
  for (const LookPart& part : look.parts)
    primitives.push_back(primitive_of(
        attributes, part.triangles,
        part.material < materials.size() ? materials[part.material] : plain_material(track, k, glb), glb));
  return primitives;
}

}  // namespace

std::vector<float> times_of(const GarmentTrack& track, bool has_rig) {
  std::vector<float> times(track.frames.size());
  const double begin = track.time_s.empty() || has_rig ? 0.0 : track.time_s[0];
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] =
        static_cast<float>(track.time_s.empty() ? static_cast<double>(i) / 30.0 : track.time_s[i] - begin);
  return times;
}

void add_garment(const Scene& scene, std::size_t k, FileSpace& space, GlbBuilder& glb,
                 GlbAnimation& animation) {
  const GarmentTrack& track = scene.garments[k];
  const std::optional<LookMesh> look = look_mesh(track);
  const Frames frames(track, space, look);
  FrameShape base = frames.base();
  const Targets targets = add_targets(frames, base, glb);
  Json attributes = {{"POSITION", glb.add_positions(base.positions)},
                     {"NORMAL", glb.add_vectors(base.normals)}};
  add_colors(track, attributes, glb);
  if (look) add_look_attributes(*look, track.mesh.positions.size(), attributes, glb);
  Json primitives =
      look
          ? look_primitives(track, k, *look, attributes, glb)
          : Json::array({primitive_of(attributes, track.mesh.triangles, plain_material(track, k, glb), glb)});
  if (!targets.list.empty())
    for (Json& primitive : primitives) primitive["targets"] = targets.list;
  Json mesh = {{"name", name_of(track)}, {"primitives", std::move(primitives)}};
  const std::vector<float> times = times_of(track, scene.rig != nullptr);
  if (!track.frames.empty()) {
    mesh["weights"] = std::vector<double>(track.frames.size(), 0.0);
    mesh["extras"] = {{"targetNames", target_names(times)}};
  }
  Json node = {{"name", name_of(track)}, {"mesh", glb.add("meshes", std::move(mesh))}};
  if (targets.scale != 1.0f) node["scale"] = {targets.scale, targets.scale, targets.scale};
  const std::size_t index = add_nodes(track, std::move(node), space, glb);
  if (takes_time(track)) animate(times, index, glb, animation);
}

}  // namespace bodice::io
