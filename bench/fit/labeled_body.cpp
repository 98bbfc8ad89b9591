#include "labeled_body.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include <bodice/engine/random.hpp>
#include <bodice/synth/body.hpp>

namespace fit_bench {
namespace {

using bodice::body::Part;
using bodice::geometry::Vec3;

constexpr Part kPartOfClass[16] = {Part::kHead,      Part::kHead,     Part::kTorsoUL,   Part::kTorsoLL,
                                   Part::kUpperArmL, Part::kForearmL, Part::kForearmL,  Part::kThighL,
                                   Part::kCalfL,     Part::kCalfL,    Part::kUpperArmR, Part::kForearmR,
                                   Part::kForearmR,  Part::kThighR,   Part::kCalfR,     Part::kCalfR};

/// Reads positions and faces of an OBJ file; false without triangles.
bool read_obj(const std::filesystem::path& file, bodice::geometry::TriMesh& mesh) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Vec3 p;
      words >> p.x() >> p.y() >> p.z();
      mesh.positions.push_back(p);
    } else if (word == "f") {
      std::vector<bodice::geometry::Index> face;
      while (words >> word) face.push_back(static_cast<bodice::geometry::Index>(std::stoul(word) - 1));
      for (std::size_t k = 2; k < face.size(); ++k) mesh.triangles.push_back({face[0], face[k - 1], face[k]});
    }
  }
  return !mesh.triangles.empty();
}

/// Splits the torso into six parts: at thirds of its height, and at the mean of x.
void split_torso(LabeledBody& body) {
  bodice::geometry::Box box;
  double x = 0.0, count = 0.0;
  for (std::size_t v = 0; v < body.part.size(); ++v)
    if (is_torso(body.part[v]))
      box.extend(body.mesh.positions[v]), x += body.mesh.positions[v].x(), count += 1.0;
  x /= count;
  for (std::size_t v = 0; v < body.part.size(); ++v) {
    if (!is_torso(body.part[v])) continue;
    const Vec3& p = body.mesh.positions[v];
    const double height = (p.y() - box.low.y()) / box.size().y();
    const int row = height > 2.0 / 3.0 ? 0 : height > 1.0 / 3.0 ? 1 : 2;
    body.part[v] = static_cast<Part>(static_cast<int>(Part::kTorsoUL) + 2 * row + (p.x() < x ? 1 : 0));
  }
}

/// The number after "stature_m" in the truth file of a body; the height of a sitting body is not its stature.
std::optional<double> stature(const std::filesystem::path& json) {
  std::ifstream in(json);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::size_t key = text.find("stature");
  const std::size_t colon = key == std::string::npos ? key : text.find(':', key);
  if (colon == std::string::npos) return std::nullopt;
  const double value = std::strtod(text.c_str() + colon + 1, nullptr);
  return value > 0.0 ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<LabeledBody> load(const std::filesystem::path& obj, const std::filesystem::path& labels) {
  LabeledBody body;
  if (!read_obj(obj, body.mesh)) return std::nullopt;
  std::ifstream in(labels);
  int label = 0;
  while (in >> label) body.part.push_back(kPartOfClass[label & 15]);
  if (body.part.size() != body.mesh.positions.size()) return std::nullopt;
  split_torso(body);
  const auto truth = stature(std::filesystem::path(obj).replace_extension(".json"));
  body.stature_m = truth.value_or(bodice::geometry::bounding_box(body.mesh.positions).size().y());
  return body;
}

std::optional<LabeledBody> make_synthetic(std::uint64_t seed) {
  using bodice::synth::Pose;
  constexpr Pose kPoses[] = {Pose::kA, Pose::kT, Pose::kArmsDown, Pose::kStride, Pose::kSit, Pose::kRun};
  bodice::engine::Random random(seed, 5);
  bodice::synth::BodyOptions options;
  options.seed = seed;
  options.sex = seed % 2 == 0 ? bodice::body::Sex::kFemale : bodice::body::Sex::kMale;
  options.stature_m = random.uniform(1.5, 1.9);
  options.mass_kg = random.uniform(19.0, 33.0) * options.stature_m * options.stature_m;
  options.pose = kPoses[seed % std::size(kPoses)];
  auto body = bodice::synth::make_body({}, options);
  if (!body) return std::nullopt;
  return LabeledBody{std::move(body->mesh), std::move(body->part), body->stature_m};
}

}  // namespace fit_bench
