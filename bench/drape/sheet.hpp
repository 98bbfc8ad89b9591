#pragma once

#include <bodice/io/scene.hpp>

#include "outfits.hpp"

namespace bench {

/// A contact sheet of outfits, from the front and from the left.
class Sheet {
 public:
  /// A skin with a garment, both at these positions.
  void add(const std::vector<bodice::geometry::Vec3>& skin,
           const std::vector<bodice::geometry::Triangle>& triangles,
           const bodice::tryon::WornGarment& garment, const std::vector<bodice::geometry::Vec3>& positions);
  /// Returns false if the picture could not be written.
  bool write(const std::filesystem::path& png) const;

 private:
  bodice::geometry::TriMesh bodies_;
  bodice::io::GarmentTrack garments_;
  int count_ = 0;
};

}  // namespace bench
