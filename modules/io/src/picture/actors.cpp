#include "actors.hpp"

#include <array>
#include <cmath>

#include "../color.hpp"
#include "../scene_check.hpp"
#include "../unit_sphere.hpp"

namespace bodice::inline v0_1::io {

using geometry::Vec3;

namespace {

constexpr std::array<float, 3> kSkin = {0.86f, 0.80f, 0.76f};
constexpr float kDarkestShade = 0.45f;

/// The proxy's surface, each vertex in the color of its owner's part.
Actor surface_actor(const proxy::BodyProxy& proxy, const proxy::ProxySurface& surface) {
  Actor actor;
  actor.triangles = surface.mesh.triangles;
  for (const Vec3& p : surface.mesh.positions) actor.positions.push_back(p.cast<float>());
  for (const Vec3& n : surface.normals) actor.normals.push_back(n.cast<float>());
  for (const std::uint32_t owner : surface.owner)
    actor.colors.push_back(to_linear(part_color(proxy.ellipsoids()[owner].part)));
  return actor;
}

}  // namespace

void add_things(const Scene& scene, std::vector<Actor>& actors) {
  for (const StillThing& thing : scene.things) {
    actors.push_back(make_actor(*thing.mesh, to_linear(part_color(body::Part::kThing)), false));
    for (std::size_t v = 0; v < thing.part.size(); ++v)
      actors.back().colors[v] = to_linear(part_color(thing.part[v]));
  }
}

Actor body_actor(const Scene& scene, SkinColor color, const std::size_t* frame) {
  const bool moves = frame && !scene.body_frames.empty();
  const Vec3f skin = to_linear(std::span(kSkin));
  Actor actor = moves ? make_actor({scene.body_frames[*frame], scene.body->triangles}, skin, false)
                      : make_actor(*scene.body, skin, false);
  if (color == SkinColor::kByPart && !scene.part.empty())
    for (std::size_t v = 0; v < actor.colors.size(); ++v)
      actor.colors[v] = to_linear(part_color(scene.part[v]));
  return actor;
}

void add_ellipsoids(const proxy::BodyProxy& proxy, bool shades, std::vector<Actor>& actors) {
  const geometry::TriMesh sphere = unit_sphere(3);
  float turn = 0.0f;  // the golden ratio keeps the shades of consecutive ellipsoids apart
  for (const proxy::ProxyEllipsoid& ellipsoid : proxy.ellipsoids()) {
    const geometry::Ellipsoid& shape = ellipsoid.shape;
    turn = std::fmod(turn + 0.618034f, 1.0f);
    const float shade = shades ? kDarkestShade + (1.0f - kDarkestShade) * turn : 1.0f;
    geometry::TriMesh mesh{{}, sphere.triangles};
    for (const Vec3& u : sphere.positions)
      mesh.positions.push_back(shape.center + shape.axes * shape.radii.cwiseProduct(u));
    actors.push_back(make_actor(mesh, shade * to_linear(part_color(ellipsoid.part)), false));
  }
}

void add_proxy(const Scene& scene, std::vector<Actor>& actors) {
  if (scene.surface)
    actors.push_back(surface_actor(*scene.proxy, *scene.surface));
  else
    add_ellipsoids(*scene.proxy, false, actors);
}

void add_garments(const Scene& scene, std::size_t frame, std::vector<Actor>& actors) {
  for (std::size_t k = 0; k < scene.garments.size(); ++k) {
    const GarmentTrack& track = scene.garments[k];
    const std::array<float, 3> color = garment_color(k);
    actors.push_back(
        make_actor({track.frames[frame], track.mesh.triangles}, to_linear(std::span(color)), true));
    for (std::size_t v = 0; v < track.colors.size(); ++v)
      actors.back().colors[v] = to_linear(std::span(track.colors[v]));
  }
}

geometry::Box box_of(const std::vector<std::vector<Actor>>& rows) {
  geometry::Box box;
  for (const auto& actors : rows)
    for (const Actor& actor : actors)
      for (const Vec3f& p : actor.positions) box.extend(p.cast<double>());
  return box;
}

}  // namespace bodice::io
