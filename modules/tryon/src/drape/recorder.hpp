// Records frames of a drape: which are kept, and the garments' own vertices in them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <bodice/io/scene.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::inline v0_1::tryon {

/// Chooses at most `kept` of the frames 0..frames, evenly spread, first and last included.
/// Preconditions: frames >= 1, kept >= 2.
std::vector<int> frames_to_keep(int frames, int kept);

/// Splits the positions of all garments into a track a garment, at the frames that are kept.
class Recorder {
 public:
  Recorder(const std::vector<WornGarment>& garments, const Wardrobe& all, std::vector<int> keep);

  /// Records the frame if it is one of those to keep, and returns whether it is. Frames come in order, from
  /// 0.
  bool record_if_kept(int frame, std::span<const geometry::Vec3> positions, double time_s);

  std::vector<io::GarmentTrack> take() { return std::move(tracks_); }

 private:
  std::vector<std::size_t> first_;  // #garments + 1
  std::vector<int> keep_;
  std::size_t next_ = 0;  // index into keep_
  std::vector<io::GarmentTrack> tracks_;
};

}  // namespace bodice::tryon
