// A scene as output sees it (GLB, pictures): the body by part, its ellipsoids, garments over time.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/proxy/proxy_surface.hpp>
#include <bodice/rig/rig.hpp>

namespace bodice::io {

struct GarmentTrack {
  std::string name;                                 ///< "cloth", "cloth_2", ...
  geometry::TriMesh mesh;                           ///< topology and first frame, meters, y up
  std::vector<std::vector<geometry::Vec3>> frames;  ///< kept frames, #V each
  std::vector<double> time_s;                       ///< of each kept frame: increasing, or all the same
};

struct Scene {
  const geometry::TriMesh* body = nullptr;
  std::span<const body::Part> part;  ///< #V of the body, or empty
  const proxy::BodyProxy* proxy = nullptr;
  const proxy::ProxySurface* surface = nullptr;  ///< of the proxy: pictures show it for the ellipsoids
  std::span<const geometry::Vec3> landmarks;     ///< points that write_stages_picture() marks
  std::vector<GarmentTrack> garments;
  geometry::Frame frame;  ///< of the input: what is written is in it, unless there is a rig
  const rig::Rig* rig =
      nullptr;  ///< moves the body: write_glb() writes skeleton, weights and clips in meters, y up
};

/// One distinct color a part, sRGB 0..1, told apart by color-blind people too as far as 15 allow.
std::span<const float, 3> part_color(body::Part part);

/// Binary glTF 2.0: nodes `body`, `ellipsoids`, `cloth`, `cloth_2`...; the cloth's frames are morph targets
/// with normals, played by a step-free animation of their weights. With a rig the body is skinned by the
/// nodes of its joints, each clip is an animation, and the garments' frames play in the first, at their own
/// times. Fails with kInvalidArgument where the parts of the scene do not fit together.
engine::Result<void> write_glb(const Scene& scene, const std::filesystem::path& file);

struct PictureOptions {
  int width = 640, height = 960;  ///< of one view, pixels
  bool show_proxy = false;        ///< its surface if there is one, or its ellipsoids, in place of the skin
  bool show_garments = true;
};

/// One PNG: a row a kept frame in `frames` (indices into GarmentTrack::frames; empty: the body alone), a
/// column for the front and the side view. Software-rendered.
engine::Result<void> write_picture(const Scene& scene, std::span<const std::size_t> frames,
                                   const std::filesystem::path& file, const PictureOptions& options = {});

/// One PNG, a row of front views that shows how a body is processed: its mesh, its landmarks, its parts, its
/// ellipsoids, and its garments at their last frame; what the scene lacks is left out. `options` gives the
/// size of a view. Fails with kInvalidArgument when the scene has no body.
engine::Result<void> write_stages_picture(const Scene& scene, const std::filesystem::path& file,
                                          const PictureOptions& options = {});

}  // namespace bodice::io
