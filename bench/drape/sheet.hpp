#pragma once

#include <bodice/io/scene.hpp>

#include "outfits.hpp"

namespace bench {

/// A contact sheet of all outfits at the end of their windy frames, from the front and from the left.
class Sheet {
 public:
  void add(const Body& body, const bodice::tryon::WornGarment& garment,
           const std::vector<bodice::geometry::Vec3>& positions);
  /// False if the picture could not be written.
  bool write(const std::filesystem::path& png) const;

 private:
  bodice::geometry::TriMesh bodies_;
  bodice::io::GarmentTrack garments_;
  int count_ = 0;
};

}  // namespace bench
