// Whom the dials are tried on: bodies made from seeds, and those of a folder, each with its exact truth.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <bodice/synth/body.hpp>
#include <bodice/tryon/prepare.hpp>

#include <bench_references/subject.hpp>

namespace tradeoff {

/// A segmented body, and places near its skin whose exact signed distance is known.
struct Subject {
  std::string name;
  bodice::tryon::SegmentedSkin skin;
  std::optional<bodice::synth::Body> made;  ///< with its true landmarks, if it was made
  bench::Cloud particles;                   ///< within 30 mm of the skin, in Morton order
  std::vector<double> truth_m;              ///< of each particle
};

/// What makes a subject, later: bodies are large, and not every sweep needs each.
struct SubjectSource {
  std::string name;
  std::function<Subject(const bodice::engine::Context&)> make;
};

/// Sex, stature, girth and pose follow from the seed; nothing was developed on these.
bodice::synth::BodyOptions body_of_seed(std::uint64_t seed, int vertices);
std::vector<SubjectSource> made_bodies(std::uint64_t first_seed, int count, int vertices);

/// Every mesh in DIR/bodies, or in DIR itself, by name.
std::vector<SubjectSource> bodies_of(const std::filesystem::path& folder);

}  // namespace tradeoff
