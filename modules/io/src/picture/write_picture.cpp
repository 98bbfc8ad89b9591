#include <bodice/io/scene.hpp>

#include "../scene_check.hpp"
#include "actors.hpp"
#include "panel.hpp"

namespace bodice::io {

namespace {

constexpr int kLargestSide = 16384;

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

/// The actors of one row; without `frame`, the body alone.
std::vector<Actor> actors_of(const Scene& scene, const std::size_t* frame, const PictureOptions& options) {
  std::vector<Actor> actors;
  const bool show_proxy = options.show_proxy && scene.proxy;
  const bool garments = options.show_garments && frame && !scene.garments.empty();
  if (show_proxy) add_proxy(scene, actors);
  if (scene.body && !show_proxy)
    actors.push_back(body_actor(scene, garments ? SkinColor::kPlain : SkinColor::kByPart));
  if (garments) add_garments(scene, *frame, actors);
  return actors;
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
  return write_png(draw(rows, options), file);
}

}  // namespace bodice::io
