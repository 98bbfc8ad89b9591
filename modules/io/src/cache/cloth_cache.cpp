// Based on: Autodesk. 3ds Max SDK, Point Cache 2 file format. 2008. - PC2;
// NewTek. LightWave SDK, Motion Designer data files. 2001. - MDD
#include <bodice/io/cloth_cache.hpp>

#include <bit>
#include <cstdint>
#include <optional>
#include <string>

#include <bodice/engine/write_file.hpp>

#include "look/look_mesh.hpp"

namespace bodice::inline v0_1::io {

namespace {

/// Appends 32-bit words in one order of bytes.
class WordWriter {
 public:
  WordWriter(std::endian order, std::string& bytes) : swap_(order != std::endian::native), bytes_(bytes) {}

  void add(std::uint32_t word) {
    const auto native = std::bit_cast<std::array<char, 4>>(word);
    for (std::size_t k = 0; k < 4; ++k) bytes_.push_back(native[swap_ ? 3 - k : k]);
  }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }

 private:
  bool swap_;
  std::string& bytes_;
};

/// The frames of a garment with the vertices of its mesh in the GLB.
class CachedFrames {
 public:
  explicit CachedFrames(const GarmentTrack& track) : track_(track), look_(look_mesh(track)) {}

  std::uint32_t vertices() const {
    return static_cast<std::uint32_t>(look_ ? look_->cloth_vertex.size() : track_.mesh.positions.size());
  }
  void add_to(WordWriter& words, const geometry::Frame& frame) const {
    for (const auto& points : track_.frames)
      for (const geometry::Vec3& p : look_ ? look_->spread(points) : points)
        for (const double v : frame.to_file(p)) words.add(static_cast<float>(v));
  }

 private:
  const GarmentTrack& track_;
  std::optional<LookMesh> look_;
};

std::string pc2(const GarmentTrack& track, const geometry::Frame& frame) {
  constexpr float kFirstFrame = 0.0f, kFramesASample = 1.0f;
  constexpr std::uint32_t kVersion = 1;
  std::string bytes("POINTCACHE2\0", 12);
  WordWriter words(std::endian::little, bytes);
  words.add(kVersion);
  const CachedFrames frames(track);
  words.add(frames.vertices());
  words.add(kFirstFrame);
  words.add(kFramesASample);
  words.add(static_cast<std::uint32_t>(track.frames.size()));
  frames.add_to(words, frame);
  return bytes;
}

std::string mdd(const GarmentTrack& track, const geometry::Frame& frame) {
  std::string bytes;
  WordWriter words(std::endian::big, bytes);
  const CachedFrames frames(track);
  words.add(static_cast<std::uint32_t>(track.frames.size()));
  words.add(frames.vertices());
  for (std::size_t f = 0; f < track.frames.size(); ++f)
    words.add(track.time_s.empty() ? 0.0f : static_cast<float>(track.time_s[f]));
  frames.add_to(words, frame);
  return bytes;
}

}  // namespace

engine::Result<void> write_cloth_cache(const GarmentTrack& track, const geometry::Frame& frame,
                                       const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (track.frames.empty())
    return engine::Error{engine::ErrorCode::kInvalidArgument,
                         "The garment '" + track.name + "' has no frame to write to '" + file.string() + "'.",
                         "Keep at least one frame."};
  if (extension == ".pc2") return engine::write_file(file, pc2(track, frame));
  if (extension == ".mdd") return engine::write_file(file, mdd(track, frame));
  return engine::Error{engine::ErrorCode::kInvalidArgument, "'" + file.string() + "' names no point cache.",
                       "Give NAME.pc2 or NAME.mdd."};
}

}  // namespace bodice::io
