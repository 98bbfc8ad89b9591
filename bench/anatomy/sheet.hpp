#pragma once

#include <filesystem>

#include <bodice/anatomy/anatomy.hpp>

#include "cases.hpp"

namespace bench {

/// A contact sheet: many bodies, colored by part, in one picture from the front and from the left.
class Sheet {
 public:
  void add(const Case& c, const bodice::anatomy::Anatomy& anatomy);
  /// False if the picture could not be written.
  bool write(const std::filesystem::path& png) const;

 private:
  bodice::geometry::TriMesh mesh_;
  std::vector<bodice::body::Part> part_;
  int count_ = 0;
};

}  // namespace bench
