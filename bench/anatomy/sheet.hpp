#pragma once

#include <filesystem>

#include <bodice/anatomy/anatomy.hpp>

namespace bench {

/// A contact sheet: many bodies, colored by part, in one picture from the front and from the left. Landmarks
/// are bars that cross the body from front to back and from side to side.
class Sheet {
 public:
  void add(const bodice::geometry::TriMesh& skin, const bodice::anatomy::Anatomy& anatomy);
  /// Returns false if the picture could not be written.
  bool write(const std::filesystem::path& png) const;

 private:
  void add_bar(const bodice::geometry::Vec3& low, const bodice::geometry::Vec3& high,
               bodice::body::Part color);

  bodice::geometry::TriMesh mesh_;
  std::vector<bodice::body::Part> part_;
  int count_ = 0;
};

}  // namespace bench
