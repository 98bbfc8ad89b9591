// Made bodies of known truth, with the coordinates that landmarks are found in.
#pragma once

#include <bodice/synth/body.hpp>

#include "coordinates/build.hpp"
#include "extremities/extremities.hpp"
#include "landmarks/base/correction.hpp"

namespace calibrate {

using bodice::geometry::Vec3;

/// What is made: a range of seeds, and in which poses.
struct Draw {
  std::uint64_t from = 0;
  std::size_t count = 0;
  bool standing = false;  ///< with an upright trunk, arms raised or not; else in all poses
};

/// A made body with everything that its landmarks are found from.
class Sample {
 public:
  /// Random sex, build (thin to obese; children and pregnant women too), pose and resolution.
  explicit Sample(std::uint64_t seed, bool standing);
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

  const bodice::synth::Body& truth() const { return truth_; }
  const bodice::anatomy::Skin& skin() const { return *skin_; }
  const bodice::anatomy::BodyCoordinates& coordinates() const { return *coordinates_; }
  /// False where the five extremities were not found, or left and right were mistaken.
  bool usable() const { return usable_; }
  bool adult() const { return adult_; }
  double size_m() const { return static_cast<double>(coordinates_->size_m()); }
  Vec3 landmark(bodice::body::LandmarkId id) const {
    return truth_.landmarks[static_cast<std::size_t>(id)].position;
  }
  Vec3 joint(const std::string& name) const;
  /// What the corrections of its landmarks are computed from.
  const bodice::anatomy::CorrectionRecords& records() const { return records_; }

 private:
  bodice::synth::Body truth_;
  std::unique_ptr<bodice::anatomy::Skin> skin_;
  std::optional<bodice::anatomy::Extremities> extremities_;
  bodice::anatomy::BodyExtremities tips_;
  std::unique_ptr<bodice::anatomy::BodyCoordinates> coordinates_;
  bodice::anatomy::CorrectionRecords records_;
  bool adult_ = true, usable_ = false;
};

/// The usable ones of the drawn bodies.
std::vector<std::unique_ptr<Sample>> make_samples(const Draw& draw);

}  // namespace calibrate
