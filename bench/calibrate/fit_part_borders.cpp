#include "fit_part_borders.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>

#include <bodice/geodesic/distance.hpp>

#include "least_squares.hpp"

namespace calibrate {
namespace {

using namespace bodice::anatomy;  // Coordinate and its enumerators, Build
using bodice::geometry::Index;

/// The classes of bench::coarse_class that a left limb has; those of the right one are kSides higher.
constexpr int kHead = 0, kChest = 1, kHips = 2, kUpperArm = 3, kForearm = 4, kThigh = 5, kCalf = 6,
              kSides = 4;
/// Skin this near to a border takes part in its fit; a fraction of the body size.
constexpr double kNearBorder = 0.06;
/// At most so many vertices of a body take part in the fit of a border, so that fine meshes do not outweigh
/// the others.
constexpr std::size_t kRowsOfBody = 300;
/// What a squared weight may cost.
constexpr std::array kBorderRidges{1e-7, 1e-6, 1e-5, 1e-4, 1e-3};
/// How many deviations off the middle nothing more is known; as in segment/part_borders.cpp.
constexpr double kMostOff = 2.5;

/// Coordinates that have one weight in common: one, or one of each side where the border has none.
using Tied = std::vector<Coordinate>;

struct BorderKind {
  const char* member;   ///< the member of the file that has the weights
  const char* follows;  ///< the member with what the build adds to each weight; null where nothing is added
  std::vector<int> outer, inner;  ///< the classes on the limb's side, of the left limb, and on the other
  bool paired;
  std::vector<Tied> terms;
};

const BorderKind kBorders[] = {{"neck",
                                "neck_follows",
                                {kHead},
                                {kChest},
                                false,
                                {{kOwnHand, kOtherHand},
                                 {kFromFront},
                                 {kFromBack},
                                 {kFromPerineum},
                                 {kHeadHandDetour},
                                 {kHeadFootDetour}}},
                               {"shoulder",
                                "shoulder_follows",
                                {kUpperArm, kForearm},
                                {kChest, kHips},
                                true,
                                {{kOwnHand},
                                 {kOtherHand},
                                 {kOwnFoot},
                                 {kFromFront},
                                 {kFromBack},
                                 {kFromPerineum},
                                 {kHandFootDetour},
                                 {kHeadHandDetour},
                                 {kHeadFootDetour},
                                 {kPastShoulder}}},
                               {"elbow", nullptr, {kForearm}, {kUpperArm}, true, {{kOwnHand}, {kOtherHand}}},
                               {"knee", "knee_follows", {kCalf}, {kThigh}, true, {{kOwnFoot}, {kOtherFoot}}},
                               {"hip",
                                "hip_follows",
                                {kThigh, kCalf},
                                {kChest, kHips},
                                true,
                                {{kOwnFoot},
                                 {kOtherFoot},
                                 {kFromFront},
                                 {kFromBack},
                                 {kFromPerineum},
                                 {kHandFootDetour},
                                 {kHeadFootDetour}}},
                               {"waist",
                                "waist_follows",
                                {kChest},
                                {kHips},
                                false,
                                {{kOwnHand, kOtherHand},
                                 {kOwnFoot, kOtherFoot},
                                 {kFromFront},
                                 {kFromBack},
                                 {kFromPerineum},
                                 {kHeadFootDetour}}}};

/// The middle of the builds, and how they spread.
struct Builds {
  Eigen::VectorXd middle = Eigen::VectorXd::Zero(kBuildCount), spread = middle;

  explicit Builds(const Samples& samples) {
    const auto count = static_cast<double>(samples.size());
    for (const Sample* sample : samples) middle += measures(*sample) / count;
    for (const Sample* sample : samples) spread += (measures(*sample) - middle).cwiseAbs2() / count;
    spread = spread.cwiseSqrt();
  }
  static Eigen::VectorXd measures(const Sample& sample) {
    const Build build = build_of(sample.coordinates());
    return Eigen::Map<const Eigen::VectorXf>(build.data(), kBuildCount).cast<double>();
  }
  /// A one, and the deviations of one body.
  Eigen::VectorXd factors(const Sample& sample) const {
    Eigen::VectorXd all(1 + kBuildCount);
    all << 1.0, (measures(sample) - middle).cwiseQuotient(spread).cwiseMax(-kMostOff).cwiseMin(kMostOff);
    return all;
  }
};

bool contains(const std::vector<int>& classes, int one, int side) {
  for (const int of_left : classes)
    if (one == (of_left >= kUpperArm ? of_left + side * kSides : of_left)) return true;
  return false;
}

/// The side of a vertex on which it lies: 1 beyond the border, -1 before it, 0 elsewhere.
std::vector<int> sides_of_border(const Sample& sample, const BorderKind& kind, int side) {
  std::vector<int> beyond(sample.classes().size());
  for (std::size_t v = 0; v < beyond.size(); ++v)
    beyond[v] = static_cast<int>(contains(kind.outer, sample.classes()[v], side)) -
                static_cast<int>(contains(kind.inner, sample.classes()[v], side));
  return beyond;
}

/// The distance of each vertex along the skin from the middles of the edges that the border crosses, meters.
bodice::geodesic::Field distances_from_border(const Sample& sample, const std::vector<int>& beyond) {
  const auto& skin = sample.skin();
  std::vector<bodice::geodesic::Seed> seeds;
  for (const auto& [a, b] : skin.edges.ends) {
    if (beyond[a] * beyond[b] != -1) continue;
    const auto half = static_cast<float>(0.5 * (skin.mesh.positions[a] - skin.mesh.positions[b]).norm());
    seeds.push_back({a, half});
    seeds.push_back({b, half});
  }
  return bodice::geodesic::distances_within(skin.graph, seeds,
                                            static_cast<float>(kNearBorder * sample.size_m()));
}

Eigen::VectorXd terms_at(const Sample& sample, const BorderKind& kind, Index vertex, int side) {
  const CoordinateArray x = sample.coordinates().at(vertex, side);
  Eigen::VectorXd terms = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(kind.terms.size()) + 1);
  for (std::size_t i = 0; i < kind.terms.size(); ++i) {
    double& sum = terms[static_cast<Eigen::Index>(i)] = 0.0;
    for (const Coordinate c : kind.terms[i]) sum += static_cast<double>(x[c]);
  }
  return terms;
}

/// The rows of one border of one body.
void add_body(const Sample& sample, const BorderKind& kind, const Eigen::VectorXd& factors,
              FoldedLeastSquares& rows) {
  for (int side = 0; side < (kind.paired ? 2 : 1); ++side) {
    const std::vector<int> beyond = sides_of_border(sample, kind, side);
    const auto distance = distances_from_border(sample, beyond);
    std::vector<Index> near;
    for (Index v = 0; v < distance.size(); ++v)
      if (beyond[v] != 0 && std::isfinite(distance[v])) near.push_back(v);
    const std::size_t step = near.size() / kRowsOfBody + 1;
    for (std::size_t i = 0; i < near.size(); i += step) {
      const Eigen::VectorXd x = (factors * terms_at(sample, kind, near[i], side).transpose()).reshaped();
      const double signed_m = beyond[near[i]] * static_cast<double>(distance[near[i]]);
      if (x.allFinite()) rows.add(sample.person(), x, signed_m / sample.size_m());
    }
  }
}

/// The weights of one factor as the file has them: one a coordinate, and the constant.
Eigen::VectorXd as_border(const BorderKind& kind, const Eigen::VectorXd& weights, int factors, int factor) {
  Eigen::VectorXd border = Eigen::VectorXd::Zero(kCoordinateCount + 1);
  for (std::size_t i = 0; i < kind.terms.size(); ++i)
    for (const Coordinate c : kind.terms[i])
      border[c] = weights[static_cast<Eigen::Index>(i) * factors + factor];
  border[kCoordinateCount] = weights[weights.size() - factors + factor];
  return border;
}

/// A border that was fitted: its weights, term by term each factor's.
struct FittedBorder {
  const BorderKind* kind;
  int factors;
  Eigen::VectorXd weights;

  /// Positive on the limb's side; about the distance from the border as a fraction of the body size.
  double score(const Sample& sample, const Eigen::VectorXd& build, Index vertex) const {
    return weights.dot((build.head(factors) * terms_at(sample, *kind, vertex, 0).transpose()).reshaped());
  }
};

FittedBorder fit_border(const BorderKind& kind, const Builds& builds, const Samples& samples) {
  const int factors = kind.follows ? 1 + kBuildCount : 1;
  FoldedLeastSquares rows((static_cast<int>(kind.terms.size()) + 1) * factors);
  for (const Sample* sample : samples) add_body(*sample, kind, builds.factors(*sample).head(factors), rows);
  const double ridge = rows.best_ridge(kBorderRidges);
  std::printf("  %s: left-out people %.2f %% of the body size off, ridge %g\n", kind.member,
              100.0 * rows.left_out_error(ridge), ridge);
  return {&kind, factors, rows.solve(ridge)};
}

void add_members(const FittedBorder& border, ordered_json& out) {
  out[border.kind->member] = rounded(as_border(*border.kind, border.weights, border.factors, 0));
  if (!border.kind->follows) return;
  Eigen::VectorXd follows(kBuildCount * (kCoordinateCount + 1));
  for (int f = 0; f < kBuildCount; ++f)
    follows.segment(f * (kCoordinateCount + 1), kCoordinateCount + 1) =
        as_border(*border.kind, border.weights, border.factors, f + 1);
  out[border.kind->follows] = rounded(follows);
}

/// A vertex between waist and neck of a made body: how far up by both scores, and on which side of
/// the true chest line.
struct BetweenWaistAndNeck {
  double share;
  bool upper;
  double weight;
};

/// Where between the borders of waist and neck the chest line of made bodies lies: the share that leaves the
/// least of the skin on the wrong side.
double fit_chest_share(const FittedBorder& waist, const FittedBorder& neck, const Builds& builds,
                       const Samples& samples) {
  using bodice::body::Part;
  std::vector<BetweenWaistAndNeck> vertices;
  double wrong = 0.0;  // with every vertex above the line
  for (const Sample* sample : samples) {
    const std::vector<Part>& truth = sample->truth().part;
    const Eigen::VectorXd build = builds.factors(*sample);
    for (Index v = 0; v < truth.size(); ++v) {
      const bool upper = truth[v] == Part::kTorsoUL || truth[v] == Part::kTorsoUR;
      if (!upper && truth[v] != Part::kTorsoML && truth[v] != Part::kTorsoMR) continue;
      const double above = waist.score(*sample, build, v), below = -neck.score(*sample, build, v);
      if (!(above > 0.0 && below > 0.0)) continue;
      const double weight = 1.0 / static_cast<double>(truth.size());
      vertices.push_back({above / (above + below), upper, weight});
      if (!upper) wrong += weight;
    }
  }
  std::ranges::sort(vertices, {}, &BetweenWaistAndNeck::share);
  double least = wrong, best = 0.0;
  for (const auto& [share, upper, weight] : vertices) {
    wrong += upper ? weight : -weight;
    if (wrong < least) least = wrong, best = share;
  }
  std::printf("  chest: at %.3f from the waist's border, 0, to the neck's, 1\n", best);
  return best;
}

}  // namespace

ordered_json fit_joint_borders(const Samples& samples) {
  const Builds builds(samples);
  ordered_json out = ordered_json::object();
  for (BorderKind kind : kBorders) {
    const std::string_view member = kind.member;
    if (member == "hip" || member == "waist") continue;  // landmarks read neither
    kind.follows = nullptr;
    add_members(fit_border(kind, builds, samples), out);
  }
  return out;
}

ordered_json fit_part_borders(const Samples& samples) {
  const Builds builds(samples);
  ordered_json out = {{"build_middle", rounded(builds.middle)}, {"build_spread", rounded(builds.spread)}};
  std::map<std::string, FittedBorder> borders;
  for (const BorderKind& kind : kBorders) {
    const FittedBorder border = fit_border(kind, builds, samples);
    add_members(border, out);
    borders.emplace(kind.member, border);
  }
  const double share = fit_chest_share(borders.at("waist"), borders.at("neck"), builds, samples);
  out["chest_share"] = rounded(Eigen::VectorXd::Constant(1, share));
  return out;
}

}  // namespace calibrate
