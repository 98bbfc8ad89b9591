#include "scene_check.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/geometry/ellipsoid.hpp>

#include "look/look.hpp"

namespace bodice::inline v0_1::io {

namespace {

using geometry::Vec3;

engine::Error invalid(std::string message) {
  return {engine::ErrorCode::kInvalidArgument, std::move(message), "This is the caller's scene: check it."};
}

bool all_finite(std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); });
}

bool valid_mesh(const geometry::TriMesh& mesh) {
  return !mesh.empty() && all_finite(mesh.positions) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const geometry::Triangle& t) {
           return *std::max_element(t.begin(), t.end()) < mesh.positions.size();
         });
}

bool fits(const proxy::ProxySurface& surface, const proxy::BodyProxy* proxy) {
  const std::size_t count = surface.mesh.positions.size();
  return proxy && valid_mesh(surface.mesh) && surface.normals.size() == count &&
         surface.owner.size() == count &&
         std::ranges::all_of(surface.owner, [&](std::uint32_t k) { return k < proxy->ellipsoids().size(); });
}

engine::Result<void> check_track(const GarmentTrack& track) {
  const std::string name = "The garment '" + track.name + "'";
  if (!valid_mesh(track.mesh)) return invalid(name + " is empty, not finite or refers to missing vertices.");
  if (!track.time_s.empty() && track.time_s.size() != track.frames.size())
    return invalid(name + " has " + std::to_string(track.frames.size()) + " frames but " +
                   std::to_string(track.time_s.size()) + " times.");
  for (const auto& frame : track.frames)
    if (frame.size() != track.mesh.positions.size() || !all_finite(frame))
      return invalid(name + " has a frame that is not finite or not of its " +
                     std::to_string(track.mesh.positions.size()) + " vertices.");
  if (!track.colors.empty() && track.colors.size() != track.mesh.positions.size())
    return invalid(name + " has " + std::to_string(track.colors.size()) + " colors for " +
                   std::to_string(track.mesh.positions.size()) + " vertices.");
  for (const auto& color : track.colors)
    if (!std::ranges::all_of(color, [](float c) { return c >= 0.0f && c <= 1.0f; }))
      return invalid(name + " has a color that is not in 0..1.");
  if (track.look && (track.look->material.size() != track.mesh.triangles.size() ||
                     track.look->uv.size() != 6 * track.look->uv_sets * track.mesh.triangles.size()))
    return invalid(name + " has " + std::to_string(track.mesh.triangles.size()) +
                   " triangles but the look of " + std::to_string(track.look->material.size()) + ".");
  for (std::size_t i = 0; i < track.time_s.size(); ++i)
    if (!std::isfinite(track.time_s[i]) ||
        (i > 0 && takes_time(track) && !(track.time_s[i] > track.time_s[i - 1])))
      return invalid(name + " has frame times that do not increase.");
  return {};
}

bool is_finite(const geometry::Ellipsoid& e) {
  return e.center.allFinite() && e.axes.allFinite() && e.radii.allFinite();
}

engine::Result<void> check_proxy_frames(const Scene& scene) {
  if (scene.proxy_frames.empty()) return {};
  const std::size_t kept = scene.garments.empty() ? 0 : scene.garments.front().frames.size();
  if (!scene.proxy || scene.proxy_frames.size() != kept)
    return invalid("The scene has ellipsoids at " + std::to_string(scene.proxy_frames.size()) +
                   " frames, but garments at " + std::to_string(kept) + ".");
  for (const auto& shapes : scene.proxy_frames)
    if (shapes.size() != scene.proxy->ellipsoids().size() || !std::ranges::all_of(shapes, is_finite))
      return invalid("The proxy has a frame that is not finite or not of its ellipsoids.");
  return {};
}

engine::Result<void> check_rig(const Scene& scene) {
  if (!scene.body) return invalid("The scene has a rig but no body that it moves.");
  if (auto checked = validate(scene.rig->skeleton); !checked) return checked;
  for (const rig::Clip& clip : scene.rig->clips)
    if (auto checked = validate(clip, scene.rig->skeleton); !checked) return checked;
  rig::SkinWeights weights = scene.rig->weights;
  const auto mended = mend(weights, scene.rig->skeleton, scene.body->positions.size());
  if (!mended) return mended.error();
  if (!mended->empty() || weights.weight.size() != scene.rig->weights.weight.size())
    return invalid("The rig's skin weights do not add up to 1, or name a joint twice: mend() them.");
  return {};
}

}  // namespace

bool takes_time(const GarmentTrack& track) {
  return track.frames.size() > 1 &&
         (track.time_s.empty() ||
          std::ranges::any_of(track.time_s, [&](double time_s) { return time_s != track.time_s.front(); }));
}

engine::Result<void> check_scene(const Scene& scene) {
  if (!scene.body && !scene.proxy && scene.garments.empty()) return invalid("The scene is empty.");
  if (!(scene.frame.meters_per_unit > 0.0 && std::isfinite(scene.frame.meters_per_unit)))
    return invalid("The scene's unit is not a positive length.");
  if (scene.body && !valid_mesh(*scene.body))
    return invalid("The body is empty, not finite or refers to missing vertices.");
  if (scene.body && !scene.part.empty() && scene.part.size() != scene.body->positions.size())
    return invalid("The body has " + std::to_string(scene.body->positions.size()) + " vertices but " +
                   std::to_string(scene.part.size()) + " parts.");
  for (const StillThing& thing : scene.things)
    if (!thing.mesh || !valid_mesh(*thing.mesh) ||
        (!thing.part.empty() && thing.part.size() != thing.mesh->positions.size()))
      return invalid("The thing '" + thing.name +
                     "' is empty, not finite or without a part for each vertex.");
  for (const auto& frame : scene.body_frames)
    if (!scene.body || frame.size() != scene.body->positions.size() || !all_finite(frame))
      return invalid("The body has a frame that is not finite or not of its vertices.");
  if (auto checked = check_proxy_frames(scene); !checked) return checked;
  if (scene.surface && !fits(*scene.surface, scene.proxy))
    return invalid("The proxy's surface is not that of the scene's proxy.");
  if (scene.rig)
    if (auto checked = check_rig(scene); !checked) return checked;
  for (const GarmentTrack& track : scene.garments)
    if (auto checked = check_track(track); !checked) return checked;
  return {};
}

geometry::Box scene_box(const Scene& scene) {
  geometry::Box box;
  if (scene.body)
    for (const Vec3& p : scene.body->positions) box.extend(p);
  for (const StillThing& thing : scene.things)
    for (const Vec3& p : thing.mesh->positions) box.extend(p);
  for (const auto& frame : scene.body_frames)
    for (const Vec3& p : frame) box.extend(p);
  if (scene.proxy && scene.proxy_frames.empty())
    for (const auto& ellipsoid : scene.proxy->ellipsoids()) {
      const geometry::Box tight = geometry::bounding_box(ellipsoid.shape);
      box.extend(tight.low);
      box.extend(tight.high);
    }
  for (const auto& shapes : scene.proxy_frames)
    for (const geometry::Ellipsoid& shape : shapes) {
      const geometry::Box tight = geometry::bounding_box(shape);
      box.extend(tight.low);
      box.extend(tight.high);
    }
  for (const GarmentTrack& track : scene.garments) {
    for (const Vec3& p : track.mesh.positions) box.extend(p);
    for (const auto& frame : track.frames)
      for (const Vec3& p : frame) box.extend(p);
  }
  return box;
}

std::array<float, 3> garment_color(std::size_t k) {
  constexpr std::array<std::array<float, 3>, 4> colors = {
      {{0.16f, 0.36f, 0.62f}, {0.72f, 0.24f, 0.28f}, {0.22f, 0.50f, 0.38f}, {0.48f, 0.36f, 0.58f}}};
  return colors[k % colors.size()];
}

}  // namespace bodice::io
