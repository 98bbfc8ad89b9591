#include "drape/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bodice::inline v0_1::tryon {

std::vector<int> frames_to_keep(int frames, int kept) {
  const int gaps = std::min(std::max(kept, 2) - 1, frames);  // frames + 1 might overflow
  std::vector<int> keep;
  for (int i = 0; i <= gaps; ++i)
    keep.push_back(static_cast<int>(std::lround(static_cast<double>(frames) * i / gaps)));
  keep.erase(std::unique(keep.begin(), keep.end()), keep.end());
  return keep;
}

Recorder::Recorder(const std::vector<WornGarment>& garments, const Wardrobe& all, std::vector<int> keep)
    : first_(all.first_vertex), keep_(std::move(keep)) {
  for (std::size_t g = 0; g < garments.size(); ++g) {
    io::GarmentTrack track;
    track.name = g == 0 ? "cloth" : "cloth_" + std::to_string(g + 1);
    track.mesh = garments[g].mesh;
    track.look = garments[g].look;
    tracks_.push_back(std::move(track));
  }
}

bool Recorder::record_if_kept(int frame, std::span<const geometry::Vec3> positions, double time_s) {
  if (next_ == keep_.size() || keep_[next_] != frame) return false;
  ++next_;
  for (std::size_t g = 0; g < tracks_.size(); ++g) {
    const auto own = positions.subspan(first_[g], first_[g + 1] - first_[g]);
    tracks_[g].frames.emplace_back(own.begin(), own.end());
    tracks_[g].time_s.push_back(time_s);
  }
  return true;
}

}  // namespace bodice::tryon
