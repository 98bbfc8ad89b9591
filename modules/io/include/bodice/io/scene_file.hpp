// Reading back what write_glb() wrote: skin, ellipsoids and cloth with their frames.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/io/scene.hpp>

namespace bodice::inline v0_1::io {

/// The content of a GLB of write_glb(), in meters, y up. What the file lacks is empty.
struct SceneFile {
  geometry::TriMesh body;
  std::vector<body::Part> part;                          ///< #V of the body, or empty
  std::vector<std::vector<geometry::Vec3>> body_frames;  ///< of a skinned body, at the times of the garments
  std::vector<proxy::ProxyEllipsoid> ellipsoids;         ///< in the order of their proxy; without joints
  std::vector<std::vector<geometry::Ellipsoid>> ellipsoid_frames;  ///< at the times of the garments
  std::vector<GarmentTrack> garments;
  std::string proxy_hash;  ///< 16 hexadecimal digits
  std::string tier;        ///< of the proxy
};

/// Reads a scene. Fails with kNotFound, kUnreadable (no glTF 2, or broken) or kInvalidArgument (a glTF that
/// write_glb() did not write). Cost: that of reading, and of skinning the body for each frame.
engine::Result<SceneFile> read_scene_file(const engine::Context& context, const std::filesystem::path& file);

}  // namespace bodice::io
