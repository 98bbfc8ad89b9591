#include "made.hpp"

#include <algorithm>
#include <limits>
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

double chest_agreement(const bodice::synth::Body& truth, const std::vector<Part>& found) {
  const auto is_upper = [](Part part) { return part == Part::kTorsoUL || part == Part::kTorsoUR; };
  const auto is_above_waist = [](Part part) { return merged(part) == Part::kTorsoUL; };
  const std::vector<double> area = vertex_areas(truth.mesh);
  double all = 0.0, held = 0.0;
  for (std::size_t v = 0; v < area.size(); ++v) {
    if (!is_above_waist(truth.part[v]) || !is_above_waist(found[v])) continue;
    all += area[v];
    held += is_upper(truth.part[v]) == is_upper(found[v]) ? area[v] : 0.0;
  }
  return held / all;
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

namespace {

using bodice::geometry::Index;
using bodice::geometry::TriMesh;

Vec3 middle(const TriMesh& mesh, Index f) {
  return (mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3.0;
}

std::vector<Index> triangles_of(const bodice::synth::Body& truth, const TriMesh& mesh, Part part) {
  std::vector<Index> found;
  for (Index f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = mesh.triangles[f];
    if (truth.part[t[0]] == part && truth.part[t[1]] == part && truth.part[t[2]] == part) found.push_back(f);
  }
  return found;
}

}  // namespace

TriMesh fused(const bodice::synth::Body& truth, const TriMesh& mesh, Part one, Part other) {
  Index f = 0, g = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Index a : triangles_of(truth, mesh, one))
    for (const Index b : triangles_of(truth, mesh, other)) {
      const double d = (middle(mesh, a) - middle(mesh, b)).squaredNorm();
      const auto &s = mesh.triangles[a], &t = mesh.triangles[b];
      const bool touch = std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) != s.end();
      if (touch || d >= least) continue;
      least = d;
      f = a;
      g = b;
    }
  const auto a = mesh.triangles[f], b = mesh.triangles[g];
  TriMesh joined{mesh.positions, {}};
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    if (t != f && t != g) joined.triangles.push_back(mesh.triangles[t]);
  for (int i = 0; i < 3; ++i) {  // walked against each other, so that the tube is oriented like the skin
    const int next = (i + 1) % 3;
    joined.triangles.push_back({a[i], a[next], b[(3 - next) % 3]});
    joined.triangles.push_back({a[i], b[(3 - next) % 3], b[(3 - i) % 3]});
  }
  return joined;
}

bodice::geometry::TriMesh skin_of(const bodice::synth::Scan& scan) {
  bodice::geometry::TriMesh skin = scan.meshes[0].shape;
  for (Vec3& p : skin.positions) p = scan.frame.to_inside(p);
  return skin;
}

}  // namespace made
