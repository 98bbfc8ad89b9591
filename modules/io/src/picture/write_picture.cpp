#include <bodice/io/scene.hpp>

#include "../scene_check.hpp"
#include "actors.hpp"
#include "legend.hpp"
#include "panel.hpp"
#include "png.hpp"

namespace bodice::inline v0_1::io {

namespace {

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
  if (options.legend && options.legend->colors.size() < 2)
    return invalid("A legend has " + std::to_string(options.legend->colors.size()) + " colors.",
                   "Give two or more.");
  for (const std::size_t frame : frames)
    if (!scene.body_frames.empty() && frame >= scene.body_frames.size())
      return invalid("Frame " + std::to_string(frame) + " of the body does not exist.",
                     "It has " + std::to_string(scene.body_frames.size()) + " frames.");
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
    actors.push_back(body_actor(scene, garments ? SkinColor::kPlain : SkinColor::kByPart, frame));
  if (!show_proxy) add_things(scene, actors);
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

/// The box of one moment, widened to the largest moment's size and put on the common ground, so that all
/// views have one scale and a body that walks stays in the middle.
geometry::Box box_around(const geometry::Box& moment, const geometry::Vec3& size, double ground) {
  const geometry::Vec3 middle = moment.center(), half = 0.5 * size;
  geometry::Box box;
  box.extend({middle.x() - half.x(), ground, middle.z() - half.z()});
  box.extend({middle.x() + half.x(), ground + size.y(), middle.z() + half.z()});
  return box;
}

Image draw_sheet(const std::vector<std::vector<Actor>>& moments, int columns, const PictureOptions& options) {
  const int count = static_cast<int>(moments.size()), rows = (count + columns - 1) / columns;
  Image image{columns * options.width, rows * options.height, {}};
  image.rgb.assign(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), 255);
  std::vector<geometry::Box> boxes;
  geometry::Vec3 size = geometry::Vec3::Zero();
  const geometry::Box all = box_of(moments);
  for (const auto& actors : moments) {
    boxes.push_back(box_of({actors}));
    size = size.cwiseMax(boxes.back().size());
  }
  size.y() = all.size().y();
  for (int k = 0; k < count; ++k) {
    const auto moment = static_cast<std::size_t>(k);
    draw_panel(moments[moment], box_around(boxes[moment], size, all.low.y()),
               options.from_left ? Side::kLeft : Side::kFront,
               {k % columns * options.width, k / columns * options.height, options.width, options.height},
               image);
  }
  return image;
}

engine::Result<void> check_sheet(std::size_t frames, int columns, const PictureOptions& options) {
  if (columns < 1 || columns > kLargestSide / std::max(1, options.width))
    return invalid("A contact sheet of " + std::to_string(columns) + " columns is too narrow or too wide.",
                   "Give 1 or more, so that all are at most 16384 pixels wide.");
  const std::size_t rows =
      (frames + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
  if (frames == 0 || rows > static_cast<std::size_t>(kLargestSide / std::max(1, options.height)))
    return invalid("A contact sheet of " + std::to_string(frames) + " frames is empty or too high.",
                   "Name frames for at most 16384 pixels of height.");
  return {};
}

}  // namespace

engine::Result<void> write_contact_sheet(const Scene& scene, std::span<const std::size_t> frames, int columns,
                                         const std::filesystem::path& file, const PictureOptions& options) {
  if (auto checked = check_scene(scene); !checked) return checked;
  if (auto checked = check_sheet(frames.size(), columns, options); !checked) return checked;
  std::vector<std::vector<Actor>> moments;
  for (const std::size_t& frame : frames) {
    if (auto checked = check_request(scene, {&frame, 1}, options); !checked) return checked;
    moments.push_back(actors_of(scene, &frame, options));
  }
  return write_png(draw_sheet(moments, columns, options), file);
}

engine::Result<void> write_picture(const Scene& scene, std::span<const std::size_t> frames,
                                   const std::filesystem::path& file, const PictureOptions& options) {
  if (auto checked = check_scene(scene); !checked) return checked;
  if (auto checked = check_request(scene, frames, options); !checked) return checked;
  std::vector<std::vector<Actor>> rows;
  for (const std::size_t& frame : frames) rows.push_back(actors_of(scene, &frame, options));
  if (frames.empty()) rows.push_back(actors_of(scene, nullptr, options));
  if (rows.front().empty())
    return invalid("The picture would show nothing.", "Give a body, or show the proxy or garments.");
  Image image = draw(rows, options);
  if (options.legend) add_legend(*options.legend, image);
  return write_png(image, file);
}

}  // namespace bodice::io
