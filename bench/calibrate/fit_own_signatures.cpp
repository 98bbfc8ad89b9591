#include "fit_own_signatures.hpp"

#include "discern_signature.hpp"
#include "landmarks/kinds/armpit_signature.hpp"

namespace calibrate {
namespace {

using bodice::anatomy::BodyCoordinates;
using bodice::body::LandmarkId;
using bodice::geometry::Index;

/// Where a search has more candidates, every second one takes part, or every third, and so on.
constexpr std::size_t kMostCandidates = 400;

/// The area around each vertex, a third of its triangles'; square meters.
std::vector<double> areas(const bodice::geometry::TriMesh& mesh) {
  std::vector<double> area(mesh.positions.size(), 0.0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (const Index v : mesh.triangles[f]) area[v] += area_vector(mesh, f).norm() / 3.0;
  return area;
}

/// The vertices that `may_be` found, with their `features` (vertex).
template <class MayBe, class Features>
std::vector<Candidate> candidates_of(const Sample& sample, const Vec3& truth, MayBe&& may_be,
                                     Features&& features) {
  const auto& mesh = sample.skin().mesh;
  const double size = sample.size_m();
  const std::vector<double> area = areas(mesh);
  std::vector<Index> vertices;
  for (Index v = 0; v < mesh.positions.size(); ++v)
    if (may_be(v) && area[v] > 0.0) vertices.push_back(v);
  const std::size_t every = vertices.size() / kMostCandidates + 1;
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < vertices.size(); i += every) {
    const Index v = vertices[i];
    candidates.push_back(
        {as_vector(features(v)), (mesh.positions[v] - truth) / size, area[v] / (size * size)});
    if (!candidates.back().features.allFinite()) candidates.pop_back();
  }
  return candidates;
}

/// Adds the search for one landmark of one body. `measures`: of the body.
template <class MayBe, class Features>
void add_search(const Sample& sample, LandmarkId id, const Eigen::VectorXd& measures, MayBe&& may_be,
                Features&& features, std::vector<Search>& searches) {
  if (!sample.knows(id)) return;
  const bodice::geometry::MeshDistance distance({}, sample.skin().mesh);
  std::vector<SignatureRow> row;
  add_row(measures, features_at(sample, distance, sample.landmark(id), features), row);
  Search search{
      sample.person(), sample.group(), {}, candidates_of(sample, sample.landmark(id), may_be, features)};
  if (row.empty() || search.candidates.empty()) return;
  search.truth = row.front();
  searches.push_back(std::move(search));
}

/// What the search adds to what candidates in front of the perineum, or the perineum in front of the fold
/// behind it, deviate less.
void add_handicaps(Search& search) {
  constexpr Eigen::Index kFromFront = 3;
  const double truth = search.truth.features[kFromFront];
  for (Candidate& candidate : search.candidates) {
    const double behind = candidate.features[kFromFront] - truth;
    if (std::abs(behind) > static_cast<double>(bodice::anatomy::kInFront))
      candidate.handicap = std::copysign(static_cast<double>(bodice::anatomy::kFoldMargin), -behind);
  }
}

}  // namespace

ordered_json fit_armpit_signature(const Samples& samples) {
  std::vector<Search> searches;
  for (const Sample* sample : samples)
    for (int side = 0; side < 2; ++side) {
      const BodyCoordinates& coordinates = sample->coordinates();
      const float half = bodice::anatomy::half_chest(coordinates, side);
      add_search(
          *sample, bodice::body::of_side(LandmarkId::kArmpitL, side),
          as_vector(bodice::anatomy::armpit_measures(coordinates, half)),
          [&](Index v) { return bodice::anatomy::may_be_armpit(coordinates, v, side); },
          [&](Index v) { return bodice::anatomy::armpit_features(coordinates, v, side, half); }, searches);
    }
  return members_of(discern_signature(
      searches, {.odd = std::vector<bool>(14, false), .likelihood = 0.01, .margin = 0.5, .deviation = 0.49}));
}

ordered_json fit_perineum_signature(const Samples& samples) {
  std::vector<Search> searches;
  for (const Sample* sample : samples) {
    const BodyCoordinates& coordinates = sample->coordinates();
    add_search(
        *sample, LandmarkId::kPerineum, as_vector(coordinates.perineum_measures()),
        [&](Index v) { return coordinates.may_be_perineum(v); },
        [&](Index v) { return coordinates.perineum_features(v); }, searches);
  }
  for (Search& search : searches) add_handicaps(search);
  std::vector<bool> odd(9, false);
  odd[1] = odd[2] = true;
  return members_of(discern_signature(searches, {.odd = odd, .likelihood = 0.03, .deviation = 0.66}));
}

}  // namespace calibrate
