// The bodies that are measured: bodies made from seeds, and those of a folder, each with exact distances.
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

/// A segmented body, and particles near its skin with their exact signed distances.
struct Subject {
  std::string name;
  bodice::tryon::SegmentedSkin skin;
  std::optional<bodice::synth::Body> made;  ///< with its true landmarks, if the body was made
  bench::Cloud particles;                   ///< within 30 mm of the skin, in Morton order
  std::vector<double> truth_m;              ///< of each particle
};

/// A subject that is made when it is needed, because bodies are large and few sweeps need all.
struct SubjectSource {
  std::string name;
  std::function<Subject(const bodice::engine::Context&)> make;
};

/// The options of a made body: sex, stature, girth and pose follow from the seed.
bodice::synth::BodyOptions body_of_seed(std::uint64_t seed, int vertices);
/// `count` made bodies of consecutive seeds.
std::vector<SubjectSource> made_bodies(std::uint64_t first_seed, int count, int vertices);

/// Every mesh in DIR/bodies, or in DIR itself, by name.
std::vector<SubjectSource> bodies_of(const std::filesystem::path& folder);

}  // namespace tradeoff
