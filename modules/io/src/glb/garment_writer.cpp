#include "garment_writer.hpp"

#include <array>

#include <bodice/engine/text.hpp>

#include "../color.hpp"
#include "../scene_check.hpp"
#include "morph_targets.hpp"

namespace bodice::io {

namespace {

/// The targets of all frames, and by how much the mesh's node must be scaled for them.
struct Targets {
  Json list = Json::array();
  float scale = 1.0f;
};

void divide(std::vector<Vec3f>& points, float scale) {
  for (Vec3f& p : points) p /= scale;  // a power of two: no digit is lost
}

/// Divides the base's positions by the scale.
Targets add_targets(const GarmentTrack& track, const FileSpace& space, FrameShape& base, GlbBuilder& glb) {
  Targets targets;
  const std::size_t count = track.frames.size(), vertices = base.positions.size();
  const auto positions = [&](std::size_t f) { return space.to_file(track.frames[f]); };
  const auto shape = [&](std::size_t f) {
    FrameShape at{positions(f), space.normals_of({track.frames[f], track.mesh.triangles})};
    if (targets.scale != 1.0f) divide(at.positions, targets.scale);
    return at;
  };
  if (2 * sizeof(Vec3f) * vertices * count <= kMostFloatTargetBytes) {
    targets.list = add_float_targets(base, count, shape, glb);
    return targets;
  }
  targets.scale = displacement_scale(base.positions, count, positions);
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

/// At each kept frame the weight of its target is one and all others are zero; between frames they are
/// linear.
void animate(const std::vector<float>& times, std::size_t node, GlbBuilder& glb, GlbAnimation& animation) {
  const std::size_t n = times.size();
  std::vector<float> weights(n * n, 0.0f);
  for (std::size_t i = 0; i < n; ++i) weights[i * n + i] = 1.0f;
  const std::size_t input = glb.add_times(times);
  animation.add(node, "weights", input, glb.add_scalars(weights), "LINEAR");
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
  FrameShape base{space.to_file(track.mesh.positions), space.normals_of(track.mesh)};
  const Targets targets = add_targets(track, space, base, glb);
  const std::array<float, 3> color = garment_color(k);
  Json attributes = {{"POSITION", glb.add_positions(base.positions)},
                     {"NORMAL", glb.add_vectors(base.normals)}};
  if (!track.colors.empty()) {
    std::vector<Vec3f> colors;
    for (const auto& srgb : track.colors) colors.push_back(to_linear(std::span(srgb)));
    attributes["COLOR_0"] = glb.add_vectors(colors);
  }
  const Vec3f tint = track.colors.empty() ? to_linear(std::span(color)) : Vec3f(Vec3f::Ones());
  Json primitive = {{"attributes", std::move(attributes)},
                    {"indices", glb.add_triangles(track.mesh.triangles)},
                    {"material", add_material(track.name.c_str(), tint, 1.0f, true, glb)}};
  if (!targets.list.empty()) primitive["targets"] = targets.list;
  Json mesh = {{"name", track.name}, {"primitives", {primitive}}};
  const std::vector<float> times = times_of(track, scene.rig != nullptr);
  if (!track.frames.empty()) {
    mesh["weights"] = std::vector<double>(track.frames.size(), 0.0);
    mesh["extras"] = {{"targetNames", target_names(times)}};
  }
  Json node = {{"name", track.name}, {"mesh", glb.add("meshes", std::move(mesh))}};
  if (targets.scale != 1.0f) node["scale"] = {targets.scale, targets.scale, targets.scale};
  const std::size_t index = space.add_top_node(std::move(node), glb);
  if (takes_time(track)) animate(times, index, glb, animation);
}

}  // namespace bodice::io
