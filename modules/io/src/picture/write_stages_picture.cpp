#include <bodice/io/scene.hpp>

#include "../color.hpp"
#include "../scene_check.hpp"
#include "../unit_sphere.hpp"
#include "actors.hpp"
#include "panel.hpp"
#include "png.hpp"

namespace bodice::inline v0_1::io {

namespace {

constexpr double kMarkRadius = 0.014;  // fraction of the body's height
constexpr std::array<float, 3> kMarkColor = {0.85f, 0.12f, 0.15f};

Actor mesh_actor(const Scene& scene) {
  Actor actor = body_actor(scene, SkinColor::kPlain);
  actor.edges = true;
  return actor;
}

/// Adds spheres in front of the body, because some landmarks lie inside it and a front view has no depth.
void add_landmarks(const Scene& scene, std::vector<Actor>& actors) {
  const geometry::Box box = geometry::bounding_box(scene.body->positions);
  const double radius = kMarkRadius * box.size().y();
  const geometry::TriMesh sphere = unit_sphere(3);
  for (const geometry::Vec3& landmark : scene.landmarks) {
    const geometry::Vec3 center(landmark.x(), landmark.y(), box.high.z() + radius);
    geometry::TriMesh mesh{{}, sphere.triangles};
    for (const geometry::Vec3& u : sphere.positions) mesh.positions.push_back(center + radius * u);
    actors.push_back(make_actor(mesh, to_linear(std::span(kMarkColor)), false));
    actors.back().casts_shadow = false;
  }
}

std::vector<std::vector<Actor>> views_of(const Scene& scene) {
  std::vector<std::vector<Actor>> views;
  views.push_back({mesh_actor(scene)});
  if (!scene.landmarks.empty()) {
    views.push_back({body_actor(scene, SkinColor::kPlain)});
    add_landmarks(scene, views.back());
  }
  if (!scene.part.empty()) views.push_back({body_actor(scene, SkinColor::kByPart)});
  if (scene.proxy) add_ellipsoids(*scene.proxy, true, views.emplace_back());
  if (!scene.garments.empty()) {
    views.push_back({body_actor(scene, SkinColor::kPlain)});
    add_garments(scene, scene.garments.front().frames.size() - 1, views.back());
  }
  return views;
}

engine::Result<void> check_request(const Scene& scene, const PictureOptions& options) {
  if (!scene.body)
    return engine::Error{engine::ErrorCode::kInvalidArgument, "The scene has no body to show.",
                         "Set Scene::body."};
  if (options.width < 16 || options.height < 16 || 5 * options.width > kLargestSide ||
      options.height > kLargestSide)
    return engine::Error{engine::ErrorCode::kInvalidArgument,
                         "Five views of " + std::to_string(options.width) + " x " +
                             std::to_string(options.height) + " pixels are too small or too large a picture.",
                         "Use views of 16 pixels or more, and at most 16384 in all."};
  for (const GarmentTrack& track : scene.garments)
    if (track.frames.size() != scene.garments.front().frames.size())
      return engine::Error{engine::ErrorCode::kInvalidArgument,
                           "The garment '" + track.name + "' has another number of frames than the first.",
                           "Give every garment the same frames."};
  return {};
}

}  // namespace

engine::Result<void> write_stages_picture(const Scene& scene, const std::filesystem::path& file,
                                          const PictureOptions& options) {
  if (auto checked = check_scene(scene); !checked) return checked;
  if (auto checked = check_request(scene, options); !checked) return checked;
  const std::vector<std::vector<Actor>> views = views_of(scene);
  Image image{static_cast<int>(views.size()) * options.width, options.height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  geometry::Box box = geometry::bounding_box(scene.body->positions);
  const double middle = box.center().z();  // only width and height have to fit into a front view
  for (const std::vector<Actor>& actors : views)
    for (const Actor& actor : actors)
      for (const Vec3f& p : actor.positions) box.extend({p.x(), p.y(), middle});
  for (std::size_t k = 0; k < views.size(); ++k)
    draw_panel(views[k], box, Side::kFront,
               {static_cast<int>(k) * options.width, 0, options.width, options.height}, image);
  return write_png(image, file);
}

}  // namespace bodice::io
