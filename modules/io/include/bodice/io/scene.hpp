// A scene for output as GLB or picture: the body by part, its ellipsoids, garments over time.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/proxy/proxy_surface.hpp>
#include <bodice/rig/rig.hpp>

namespace bodice::inline v0_1::io {

struct Look;

/// A garment over time.
struct GarmentTrack {
  std::string name;                                 ///< "cloth", "cloth_2", ...
  geometry::TriMesh mesh;                           ///< topology and first frame, meters, y up
  std::vector<std::vector<geometry::Vec3>> frames;  ///< kept frames, #V each
  std::vector<double> time_s;                       ///< time of each kept frame: increasing, or all equal
  /// Colors of a map over the garment, sRGB 0..1, #V; empty: the garment has one color.
  std::vector<std::array<float, 3>> colors;
  /// What import_garment() read beside a mesh with these triangles; null: the garment is plain. With
  /// `colors` its name alone is used.
  std::shared_ptr<const Look> look = nullptr;
};

/// A thing that stands still beside the body.
struct StillThing {
  std::string name;                         ///< "prop", "prop_2", ...
  const geometry::TriMesh* mesh = nullptr;  ///< meters, y up
  std::span<const body::Part> part;         ///< #V, or empty
};

/// What an output shows. It refers to data that must outlive it; all members are optional.
struct Scene {
  const geometry::TriMesh* body = nullptr;
  std::span<const body::Part> part;  ///< #V of the body, or empty
  /// Skin of a body that moves, #V at each kept frame of the garments; empty: the body stands still.
  std::span<const std::vector<geometry::Vec3>> body_frames;
  const proxy::BodyProxy* proxy = nullptr;
  /// Ellipsoids of a proxy that moves, as many as `proxy` has, at each kept frame of the garments; empty:
  /// they stand still.
  std::span<const std::vector<geometry::Ellipsoid>> proxy_frames;
  const proxy::ProxySurface* surface = nullptr;  ///< the proxy's; pictures show it in place of ellipsoids
  std::span<const geometry::Vec3> landmarks;     ///< points that write_stages_picture() marks
  std::vector<GarmentTrack> garments;
  std::vector<StillThing> things;
  geometry::Frame frame;  ///< unit and axes of the output: those of the input; not used with a rig
  /// Moves the body: write_glb() writes skeleton, weights and clips, in meters, y up.
  const rig::Rig* rig = nullptr;
};

/// The color of a part, sRGB 0..1. Those of a body's 15 parts are distinct, for color-blind people as far as
/// 15 can be; parts of things are brown and gray.
std::span<const float, 3> part_color(body::Part part);

/// Writes binary glTF 2.0 with nodes `body`, `prop`, `ellipsoids`, `cloth`, `cloth_2`... The cloth's frames
/// are morph targets with normals; an animation of their weights plays them, linear in between. Ellipsoids
/// that move have keys of their nodes at the same times. With a rig the body is skinned by the nodes of its
/// joints, each clip is an animation, and the garments' frames play in the first one, at their own times.
/// Fails with kInvalidArgument for a scene that cannot be drawn or with parts that do not fit together, and
/// with kWriteFailed. O(size of the file), in memory as well.
engine::Result<void> write_glb(const Scene& scene, const std::filesystem::path& file);

/// A scale of colors, which a picture shows in a strip below it.
struct Legend {
  std::vector<std::array<float, 3>> colors;  ///< sRGB 0..1, two or more, evenly from least to most
  double least = 0.0, most = 1.0;            ///< numbers at the ends
  std::string unit;                          ///< "mm"
  std::string at_least, at_most;             ///< what the ends mean, in lower-case letters
};

/// Size and content of a picture.
struct PictureOptions {
  int width = 640, height = 960;  ///< size of one view, pixels
  bool show_proxy = false;        ///< in place of the skin: its surface if there is one, else its ellipsoids
  bool show_garments = true;
  bool from_left = false;                       ///< contact sheets: the left side in place of the front
  std::optional<Legend> legend = std::nullopt;  ///< write_picture() draws it below the views
};

/// Writes a PNG with a row for each kept frame in `frames` (indices into GarmentTrack::frames; empty: the
/// body alone), and a column each for the front and the side view. Rendered in software: O(#triangles +
/// #pixels) a view. Fails as write_glb() does.
engine::Result<void> write_picture(const Scene& scene, std::span<const std::size_t> frames,
                                   const std::filesystem::path& file, const PictureOptions& options = {});

/// One PNG, a grid of one view for each kept frame in `frames`, `columns` in a row, from the front or from
/// the left side. Fails with kInvalidArgument as write_picture() does.
engine::Result<void> write_contact_sheet(const Scene& scene, std::span<const std::size_t> frames, int columns,
                                         const std::filesystem::path& file,
                                         const PictureOptions& options = {});

/// Writes a PNG with a row of front views of the steps of processing: mesh, landmarks, parts, ellipsoids, and
/// garments at their last frame. What the scene lacks is left out. `options` gives the size of a view. Fails
/// with kInvalidArgument when the scene has no body, and as write_glb() does.
engine::Result<void> write_stages_picture(const Scene& scene, const std::filesystem::path& file,
                                          const PictureOptions& options = {});

}  // namespace bodice::io
