#include "made.hpp"

#include <stdexcept>

#include <bodice/engine/random.hpp>

namespace made {
namespace {

using bodice::body::Part;

constexpr double kBand = 0.03 / 1.7;  // of the stature

/// Torso quarters that the truth and the method may cut at different heights count as one.
Part merged(Part part) {
  if (part == Part::kTorsoLR) return Part::kTorsoLL;
  return bodice::body::is_torso(part) && part != Part::kTorsoLL ? Part::kTorsoUL : part;
}

std::vector<double> vertex_areas(const bodice::geometry::TriMesh& mesh) {
  std::vector<double> area(mesh.positions.size(), 0.0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (const auto v : mesh.triangles[f]) area[v] += bodice::geometry::area_vector(mesh, f).norm() / 6.0;
  return area;
}

std::vector<Vec3> true_border(const bodice::synth::Body& truth) {
  std::vector<Vec3> border;
  for (const auto& t : truth.mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      if (a < b && merged(truth.part[a]) != merged(truth.part[b]))
        border.push_back(0.5 * (truth.mesh.positions[a] + truth.mesh.positions[b]));
    }
  return border;
}

/// Area-weighted share of the vertices away from borders for which `counts` and `holds`.
template <class Counts, class Holds>
double share(const bodice::synth::Body& truth, Counts counts, Holds holds) {
  const std::vector<Vec3> border = true_border(truth);
  const std::vector<double> area = vertex_areas(truth.mesh);
  const double band = kBand * truth.stature_m;
  double all = 0.0, held = 0.0;
  for (std::size_t v = 0; v < area.size(); ++v) {
    if (!counts(v)) continue;
    bool near = false;
    for (const Vec3& p : border) near = near || (p - truth.mesh.positions[v]).squaredNorm() < band * band;
    if (near) continue;
    all += area[v];
    held += holds(v) ? area[v] : 0.0;
  }
  return all > 0.0 ? held / all : 0.0;
}

}  // namespace

bodice::synth::Body random_body(std::uint64_t seed) {
  bodice::engine::Random random(seed, 7);
  bodice::synth::BodyOptions options;
  options.sex = random.below(2) == 0 ? bodice::body::Sex::kFemale : bodice::body::Sex::kMale;
  options.stature_m = random.uniform(1.45, 1.95);
  options.mass_kg = random.uniform(18.0, 34.0) * options.stature_m * options.stature_m;
  options.pose = static_cast<bodice::synth::Pose>(
      random.below(static_cast<std::uint64_t>(bodice::synth::Pose::kRandom) + 1));
  options.vertices = static_cast<int>(random.uniform(1500.0, 6000.0));
  options.seed = seed + 1;
  auto body = bodice::synth::make_body({}, options);
  if (!body) throw std::runtime_error(body.error().sentence());
  return std::move(body.value());
}

double agreement(const bodice::synth::Body& truth, const std::vector<Part>& found) {
  return share(
      truth, [](std::size_t) { return true; },
      [&](std::size_t v) { return merged(truth.part[v]) == merged(found[v]); });
}

double swapped(const bodice::synth::Body& truth, const std::vector<Part>& found) {
  return share(
      truth, [&](std::size_t v) { return truth.part[v] >= Part::kUpperArmL; },
      [&](std::size_t v) { return bodice::body::mirrored(truth.part[v]) == found[v]; });
}

double error(const bodice::synth::Body& truth, const bodice::anatomy::Anatomy& found,
             bodice::body::LandmarkId id) {
  const auto i = static_cast<std::size_t>(id);
  return (truth.landmarks[i].position - found.landmarks[i].position).norm() / truth.stature_m;
}

}  // namespace made
