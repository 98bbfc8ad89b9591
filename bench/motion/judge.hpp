// Errors of one method over the frames of a clip.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "truth.hpp"

namespace bench {

/// Mean, 95th percentile and largest of a quantity, millimeters.
struct Spread_mm {
  double mean = 0.0, p95 = 0.0, max = 0.0;
};

/// Collects the answers of one method. The names coverage, protrusion and surface gap are those that robot
/// tools judge sphere models by.
class Judge {
 public:
  void add(const Truth& truth, std::span<const float> distance_m);

  Spread_mm error() const;          ///< error of the distance within 30 mm of the skin
  Spread_mm protrusion() const;     ///< how far the surface lies over the skin, over skin that it covers
  Spread_mm gap() const;            ///< how far it lies under the skin, over skin that it leaves bare
  double missed_percent() const;    ///< points near the skin that are deeper than 1 mm, but called outside
  double false_percent() const;     ///< points near the skin that are over 1 mm outside, but called inside
  double coverage_percent() const;  ///< share of the volume inside the skin that is called inside
  const std::vector<Spread_mm>& of_frame() const { return frames_; }
  const bodice::geometry::Vec3& worst_point() const { return worst_point_; }
  std::size_t worst_frame() const { return worst_frame_; }
  std::size_t points() const { return errors_.size(); }

 private:
  std::vector<double> errors_, over_, under_;  // mm
  std::vector<Spread_mm> frames_;
  std::size_t missed_ = 0, false_ = 0, interior_ = 0, covered_ = 0, worst_frame_ = 0;
  double worst_mm_ = 0.0;
  bodice::geometry::Vec3 worst_point_ = bodice::geometry::Vec3::Zero();
};

}  // namespace bench
