// The error and time of distances along the skin, and the error of the landmarks that follow from them.
#include <algorithm>
#include <cmath>

#include <bodice/geodesic/distance_solver.hpp>

#include <bench_references/exact_geodesic.hpp>
#include "contender.hpp"
#include "sweep.hpp"

namespace tradeoff {
namespace {

using namespace bodice;

constexpr std::pair<const char*, geodesic::Method> kMethods[] = {
    {"edges (the paper's)", geodesic::Method::kEdges},
    {"unfolded", geodesic::Method::kUnfolded},
    {"fast marching", geodesic::Method::kFastMarching}};

/// The error of a field against exact polyhedral distances, beyond a twentieth of the largest one.
struct FieldError {
  double sum = 0.0, worst = 0.0, worst_mm = 0.0, count = 0.0;

  void add(const geodesic::Field& field, const std::vector<double>& exact) {
    const double near = 0.05 * *std::max_element(exact.begin(), exact.end());
    for (std::size_t v = 0; v < field.size(); ++v) {
      if (exact[v] < near) continue;
      const double off = std::abs(static_cast<double>(field[v]) - exact[v]);
      sum += off / exact[v], count += 1.0;
      worst = std::max(worst, off / exact[v]), worst_mm = std::max(worst_mm, 1e3 * off);
    }
  }
};

bench::Table methods(const Setting& setting, const Subject& subject) {
  bench::Table table(
      "geodesics", "One field from one source, against exact polyhedral distances.",
      {"method", "vertices", "mean_%", "max_%", "max_mm", "field_us", "times_the_papers_timed"});
  const geometry::TriMesh& mesh = subject.skin.input.skin;
  const geometry::MeshEdges edges = geometry::mesh_edges(mesh);
  const std::size_t sources = setting.by_effort<std::size_t>(1, 1, 3);
  std::vector<geometry::Index> source;
  std::vector<std::vector<double>> exact;
  for (std::size_t s = 0; s < sources; ++s) {
    progress("geodesics", "exact distances, source " + std::to_string(s + 1));
    source.push_back(static_cast<geometry::Index>(s * mesh.positions.size() / sources));
    exact.push_back(bench::exact_distances(mesh, edges, source.back()));
  }
  double of_edges = 0.0;
  for (const auto& [name, method] : kMethods) {
    const geodesic::DistanceSolver solver({}, mesh, edges, method);
    FieldError error;
    for (std::size_t s = 0; s < sources; ++s) error.add(solver.distances_from(source[s]), exact[s]);
    const double us = least_us([&] { solver.distances_from(source[0]); }, 3);
    if (of_edges == 0.0) of_edges = us;
    table.add({name, mesh.positions.size(), 100.0 * error.sum / error.count, 100.0 * error.worst,
               error.worst_mm, us, us / of_edges});
  }
  return table;
}

void add_landmarks(const Subject& subject, bench::Table& table) {
  double sum = 0.0, worst = 0.0, least_confidence = 1.0;
  std::string worst_name;
  const auto& found = subject.skin.anatomy.landmarks;
  for (const body::Landmark& truth : subject.made->landmarks) {
    const auto at = std::ranges::find(found, truth.id, &body::Landmark::id);
    if (at == found.end()) continue;
    const double mm = 1e3 * (at->position - truth.position).norm();
    sum += mm;
    least_confidence = std::min(least_confidence, at->confidence);
    if (mm > worst) worst = mm, worst_name = body::name(truth.id);
  }
  double ms = 0.0;
  for (const engine::StageTime& stage : subject.skin.anatomy.stages) ms += stage.ms;
  table.add({subject.name, subject.skin.input.skin.positions.size(),
             sum / static_cast<double>(body::kLandmarkCount), worst, worst_name, least_confidence, ms});
}

}  // namespace

Findings sweep_geodesics(const Setting& setting) {
  bench::Table landmarks(
      "landmarks", "All thirteen landmarks of made bodies against where they were made, six poses.",
      {"body", "vertices", "mean_mm", "max_mm", "worst", "least_confidence", "analysis_ms"});
  Findings found;
  const auto bodies = made_bodies(0, setting.bodies(1, 2, 6), setting.vertices());
  for (const SubjectSource& source : bodies) {
    progress("geodesics", source.name + ", landmarks");
    const Subject subject = source.make(setting.context);
    if (&source == &bodies.front()) found.shown.push_back(methods(setting, subject));
    add_landmarks(subject, landmarks);
  }
  found.text =
      "The analysis uses one method; the errors of a method in millimeters bound how far it moves a "
      "landmark.\n";
  found.shown.push_back(std::move(landmarks));
  return found;
}

}  // namespace tradeoff
