// Made bodies of known truth, with the coordinates that landmarks are found in.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>

#include <bodice/body/joint.hpp>
#include <bodice/synth/body.hpp>

#include "../anatomy/cases.hpp"
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

/// Where a body comes from and how it stands: each group counts alike in a fit of corrections.
enum class Group { kFileAtRest, kFilePosed, kRig, kMadeAtRest, kMadePosed };
inline constexpr std::size_t kGroupCount = 5;

/// A body of known truth with everything that its landmarks are found from.
class Sample {
 public:
  /// A made body: random sex, build (thin to obese; children and pregnant women too), pose and resolution.
  explicit Sample(std::uint64_t seed, bool standing);
  /// A body of a file, or of a rig in a random pose; it counts `weight` times where groups do not count.
  Sample(const bench::Case& body, std::size_t person, Group group, int weight);
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

  /// The labels and joints of a made body; empty for a body of a file.
  const bodice::synth::Body& truth() const { return truth_; }
  /// The class of each vertex by bench::coarse_class; -1 where the truth is not known.
  const std::vector<int>& classes() const { return classes_; }
  double stature_m() const { return stature_m_; }
  /// Bodies of one person are left out of a fit together.
  std::size_t person() const { return person_; }
  int weight() const { return weight_; }
  Group group() const { return group_; }
  const bodice::anatomy::Skin& skin() const { return *skin_; }
  const bodice::anatomy::BodyCoordinates& coordinates() const { return *coordinates_; }
  /// Returns false where the five extremities were not found, or left and right were mistaken.
  bool usable() const { return usable_; }
  bool adult() const { return adult_; }
  double size_m() const { return static_cast<double>(coordinates_->size_m()); }
  bool knows(bodice::body::LandmarkId id) const {
    return landmarks_[static_cast<std::size_t>(id)].has_value();
  }
  /// Precondition: knows(id).
  Vec3 landmark(bodice::body::LandmarkId id) const { return *landmarks_[static_cast<std::size_t>(id)]; }
  Vec3 joint(const std::string& name) const;
  /// The true position of a joint of the common skeleton, where it is known.
  std::optional<Vec3> skeleton_joint(bodice::body::JointId id) const;
  /// Whether it stands, so that its stature is measured and not estimated.
  bool stands() const;
  /// What the corrections of its landmarks are computed from, with those on trial in place of the files'.
  bodice::anatomy::CorrectionRecords records(const bodice::anatomy::TrialCoefficients& trial) const;

 private:
  void analyze();

  bodice::synth::Body truth_;
  std::vector<int> classes_;
  std::array<std::optional<Vec3>, bodice::body::kLandmarkCount> landmarks_;
  std::array<std::optional<Vec3>, bodice::body::kJointCount> joints_;
  double stature_m_ = 0.0;
  std::size_t person_ = 0;
  int weight_ = 1;
  Group group_ = Group::kMadePosed;
  std::unique_ptr<bodice::anatomy::Skin> skin_;
  std::optional<bodice::anatomy::Extremities> extremities_;
  bodice::anatomy::BodyExtremities tips_;
  std::unique_ptr<bodice::anatomy::BodyCoordinates> coordinates_;
  bool adult_ = true, usable_ = false;
};

using OwnedSamples = std::vector<std::unique_ptr<Sample>>;

/// The usable ones of the drawn bodies.
OwnedSamples make_samples(const Draw& draw);

/// The usable ones of the bodies of a data folder, at rest and posed, and of `count` random poses of them.
OwnedSamples read_samples(const std::filesystem::path& data, std::size_t count);

}  // namespace calibrate
