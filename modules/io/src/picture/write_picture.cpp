#include <array>

#include <bodice/engine/write_file.hpp>
#include <bodice/io/scene.hpp>

#include "../color.hpp"
#include "../scene_check.hpp"
#include "../unit_sphere.hpp"
#include "panel.hpp"

namespace bodice::io {

namespace {

using geometry::Vec3;

constexpr int kLargestSide = 16384;
constexpr std::array<float, 3> kSkin = {0.86f, 0.80f, 0.76f};

engine::Error invalid(std::string message, std::string remedy) {
  return {engine::ErrorCode::kInvalidArgument, std::move(message), std::move(remedy)};
}

engine::Result<void> check_request(const Scene& scene, std::span<const std::size_t> frames,
                                   const PictureOptions& options) {
  const auto rows = std::max<std::size_t>(1, frames.size());
  if (options.width < 16 || options.height < 16 || 2 * options.width > kLargestSide ||
      rows > static_cast<std::size_t>(kLargestSide / options.height))
    return invalid("A picture of " + std::to_string(rows) + " rows of " + std::to_string(options.width) +
                       " x " + std::to_string(options.height) + " pixels is too small or too large.",
                   "Use views of 16 pixels or more, and at most 16384 in all.");
  for (const std::size_t frame : frames)
    for (const GarmentTrack& track : scene.garments)
      if (frame >= track.frames.size())
        return invalid(
            "Frame " + std::to_string(frame) + " of the garment '" + track.name + "' does not exist.",
            "It has " + std::to_string(track.frames.size()) + " frames.");
  return {};
}

Actor body_actor(const Scene& scene, bool by_part) {
  Actor actor = make_actor(*scene.body, to_linear(std::span(kSkin)), false);
  if (by_part && !scene.part.empty())
    for (std::size_t v = 0; v < actor.colors.size(); ++v)
      actor.colors[v] = to_linear(part_color(scene.part[v]));
  return actor;
}

void add_ellipsoids(const proxy::BodyProxy& proxy, std::vector<Actor>& actors) {
  const geometry::TriMesh sphere = unit_sphere(3);
  for (const proxy::ProxyEllipsoid& ellipsoid : proxy.ellipsoids()) {
    const geometry::Ellipsoid& shape = ellipsoid.shape;
    geometry::TriMesh mesh{{}, sphere.triangles};
    for (const Vec3& u : sphere.positions)
      mesh.positions.push_back(shape.center + shape.axes * shape.radii.cwiseProduct(u));
    actors.push_back(make_actor(mesh, to_linear(part_color(ellipsoid.part)), false));
  }
}

/// In the colors of the parts whose ellipsoids make it.
Actor surface_actor(const proxy::BodyProxy& proxy, const proxy::ProxySurface& surface) {
  Actor actor;
  actor.triangles = surface.mesh.triangles;
  for (const Vec3& p : surface.mesh.positions) actor.positions.push_back(p.cast<float>());
  for (const Vec3& n : surface.normals) actor.normals.push_back(n.cast<float>());
  for (const std::uint32_t owner : surface.owner)
    actor.colors.push_back(to_linear(part_color(proxy.ellipsoids()[owner].part)));
  return actor;
}

void add_proxy(const Scene& scene, std::vector<Actor>& actors) {
  if (scene.surface)
    actors.push_back(surface_actor(*scene.proxy, *scene.surface));
  else
    add_ellipsoids(*scene.proxy, actors);
}

/// Everything of one moment; `frame` absent: the body alone.
std::vector<Actor> actors_of(const Scene& scene, const std::size_t* frame, const PictureOptions& options) {
  std::vector<Actor> actors;
  const bool show_proxy = options.show_proxy && scene.proxy;
  const bool garments = options.show_garments && frame && !scene.garments.empty();
  if (show_proxy) add_proxy(scene, actors);
  if (scene.body && !show_proxy) actors.push_back(body_actor(scene, !garments));
  if (!garments) return actors;
  for (std::size_t k = 0; k < scene.garments.size(); ++k) {
    const GarmentTrack& track = scene.garments[k];
    const std::array<float, 3> color = garment_color(k);
    actors.push_back(
        make_actor({track.frames[*frame], track.mesh.triangles}, to_linear(std::span(color)), true));
  }
  return actors;
}

geometry::Box box_of(const std::vector<std::vector<Actor>>& rows) {
  geometry::Box box;
  for (const auto& actors : rows)
    for (const Actor& actor : actors)
      for (const Vec3f& p : actor.positions) box.extend(p.cast<double>());
  return box;
}

Image draw(const std::vector<std::vector<Actor>>& rows, const PictureOptions& options) {
  Image image{2 * options.width, static_cast<int>(rows.size()) * options.height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const geometry::Box box = box_of(rows);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Rectangle where{0, static_cast<int>(row) * options.height, options.width, options.height};
    draw_panel(rows[row], box, Side::kFront, where, image);
    where.x = options.width;
    draw_panel(rows[row], box, Side::kLeft, where, image);
  }
  return image;
}

}  // namespace

engine::Result<void> write_picture(const Scene& scene, std::span<const std::size_t> frames,
                                   const std::filesystem::path& file, const PictureOptions& options) {
  if (auto checked = check_scene(scene); !checked) return checked;
  if (auto checked = check_request(scene, frames, options); !checked) return checked;
  std::vector<std::vector<Actor>> rows;
  for (const std::size_t& frame : frames) rows.push_back(actors_of(scene, &frame, options));
  if (frames.empty()) rows.push_back(actors_of(scene, nullptr, options));
  if (rows.front().empty())
    return invalid("The picture would show nothing.", "Give a body, or show the proxy or garments.");
  const std::vector<std::byte> png = encode_png(draw(rows, options));
  if (png.empty())
    return engine::Error{engine::ErrorCode::kWriteFailed,
                         "'" + file.string() + "' could not be encoded as PNG.", "Use a smaller picture."};
  return engine::write_file(file, png);
}

}  // namespace bodice::io
