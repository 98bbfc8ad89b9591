#include "bodies.hpp"

#include <algorithm>
#include <iterator>

#include <bodice/engine/random.hpp>

#include <bench_references/near_skin.hpp>
#include "must.hpp"

namespace tradeoff {
namespace {

namespace fs = std::filesystem;
using namespace bodice;

constexpr double kBand_m = 0.030;

/// Adds particles and their exact distances, which belong to the rounded positions that the contenders get.
void add_truth(const engine::Context& context, Subject& subject) {
  const geometry::MeshDistance& skin = *subject.skin.distance;
  bench::Cloud near;
  for (const bench::Probe& probe : bench::near_skin_probes(context, subject.skin.input.skin, skin))
    if (std::abs(probe.signed_distance_m) < kBand_m) near.add(probe.point);
  subject.particles = bench::coherent(near);
  for (std::size_t i = 0; i < subject.particles.size(); ++i)
    subject.truth_m.push_back(skin.signed_distance(subject.particles.at(i)));
}

Subject from_skin(const engine::Context& context, std::string name, tryon::SegmentedSkin skin,
                  std::optional<synth::Body> made) {
  Subject subject{std::move(name), std::move(skin), std::move(made), {}, {}};
  add_truth(context, subject);
  return subject;
}

std::vector<fs::path> meshes_in(const fs::path& folder) {
  const fs::path bodies = fs::is_directory(folder / "bodies") ? folder / "bodies" : folder;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(bodies)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".obj" || ending == ".ply" || ending == ".glb") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

synth::BodyOptions body_of_seed(std::uint64_t seed, int vertices) {
  using synth::Pose;
  constexpr Pose kPoses[] = {Pose::kA, Pose::kStride, Pose::kT, Pose::kArmsDown, Pose::kRun, Pose::kSit};
  engine::Random random(seed, 11);
  synth::BodyOptions options;
  options.seed = seed;
  options.vertices = vertices;
  options.pose = kPoses[seed % std::size(kPoses)];
  if (seed == 0) return options;  // seed 0 is the built-in body
  options.sex = seed % 2 == 0 ? body::Sex::kFemale : body::Sex::kMale;
  options.stature_m = random.uniform(1.5, 1.9);
  options.mass_kg = random.uniform(19.0, 33.0) * options.stature_m * options.stature_m;
  return options;
}

std::vector<SubjectSource> made_bodies(std::uint64_t first_seed, int count, int vertices) {
  std::vector<SubjectSource> sources;
  for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(count); ++seed) {
    const std::string name = "made_" + std::to_string(seed);
    const synth::BodyOptions options = body_of_seed(seed, vertices);
    sources.push_back({name, [name, options](const engine::Context& context) {
                         return from_skin(context, name, must(tryon::segment_builtin(context, options, {})),
                                          must(synth::make_body(context, options)));
                       }});
  }
  return sources;
}

std::vector<SubjectSource> bodies_of(const fs::path& folder) {
  std::vector<SubjectSource> sources;
  for (const fs::path& file : meshes_in(folder)) {
    const std::string name = file.stem().string();
    sources.push_back({name, [name, file](const engine::Context& context) {
                         return from_skin(context, name, must(tryon::segment_file(context, file, {})), {});
                       }});
  }
  return sources;
}

}  // namespace tradeoff
