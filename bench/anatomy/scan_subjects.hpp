// Real bodies as the subjects of made scans.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <bodice/synth/scan.hpp>

#include "rig_cases.hpp"

namespace bench {

/// The bodies of the data folder at rest, each in the poses that scans ask for: people stand with arms at
/// any angle, let them hang, or sit upright. Landmarks are the data's; those that it lacks, and the parts by
/// which a body is cut to pieces, are found on the clean skin.
class RealSubjects {
 public:
  explicit RealSubjects(const std::filesystem::path& data);
  /// The bodies of scan number `seed`. Empty if the body cannot be analyzed.
  std::optional<bodice::synth::ScanSubjects> of(bodice::synth::ScanKind kind, std::uint64_t seed) const;

 private:
  bodice::synth::Body posed(bodice::synth::ScanKind kind, std::uint64_t seed) const;

  std::vector<RiggedBody> bodies_;
};

}  // namespace bench
