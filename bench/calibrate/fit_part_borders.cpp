#include "fit_part_borders.hpp"

#include <cmath>
#include <cstdio>

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

/// The rows of one border: a system for each part of the people, so that each part can be left out.
class FoldedRows {
 public:
  FoldedRows(const BorderKind& kind, int factors)
      : factors_(factors),
        folds_(kFolds, LeastSquares((static_cast<int>(kind.terms.size()) + 1) * factors)) {}

  void add_body(const Sample& sample, const BorderKind& kind, const Builds& builds) {
    const Eigen::VectorXd factors = builds.factors(sample).head(factors_);
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
        if (x.allFinite()) folds_[sample.person() % kFolds].add(x, signed_m / sample.size_m());
      }
    }
  }
  /// The weights, term by term each factor's, by all people but those of a part; kFolds: by all.
  Eigen::VectorXd solve(double ridge, std::size_t without) const {
    LeastSquares all(folds_.front().unknowns());
    for (std::size_t fold = 0; fold < kFolds; ++fold)
      if (fold != without) all += folds_[fold];
    return all.solve(ridge).col(0);
  }
  /// Root mean square error on the people left out, as a fraction of the body size.
  double left_out_error(double ridge) const {
    double squares = 0.0, rows = 0.0;
    for (std::size_t fold = 0; fold < kFolds; ++fold) {
      if (folds_[fold].rows() == 0) continue;
      squares += folds_[fold].squared_error(solve(ridge, fold));
      rows += static_cast<double>(folds_[fold].rows());
    }
    return std::sqrt(squares / rows);
  }

 private:
  int factors_;
  std::vector<LeastSquares> folds_;
};

/// The weights of one factor as the file has them: one a coordinate, and the constant.
Eigen::VectorXd as_border(const BorderKind& kind, const Eigen::VectorXd& weights, int factors, int factor) {
  Eigen::VectorXd border = Eigen::VectorXd::Zero(kCoordinateCount + 1);
  for (std::size_t i = 0; i < kind.terms.size(); ++i)
    for (const Coordinate c : kind.terms[i])
      border[c] = weights[static_cast<Eigen::Index>(i) * factors + factor];
  border[kCoordinateCount] = weights[weights.size() - factors + factor];
  return border;
}

void add_border(const BorderKind& kind, const Builds& builds, const Samples& samples, ordered_json& out) {
  const int factors = kind.follows ? 1 + kBuildCount : 1;
  FoldedRows rows(kind, factors);
  for (const Sample* sample : samples) rows.add_body(*sample, kind, builds);
  double ridge = kBorderRidges.front();
  for (const double other : kBorderRidges)
    if (rows.left_out_error(other) < rows.left_out_error(ridge)) ridge = other;
  const Eigen::VectorXd weights = rows.solve(ridge, kFolds);
  std::printf("  %s: left-out people %.2f %% of the body size off, ridge %g\n", kind.member,
              100.0 * rows.left_out_error(ridge), ridge);
  out[kind.member] = rounded(as_border(kind, weights, factors, 0));
  if (!kind.follows) return;
  Eigen::VectorXd follows(kBuildCount * (kCoordinateCount + 1));
  for (int f = 0; f < kBuildCount; ++f)
    follows.segment(f * (kCoordinateCount + 1), kCoordinateCount + 1) =
        as_border(kind, weights, factors, f + 1);
  out[kind.follows] = rounded(follows);
}

}  // namespace

ordered_json fit_part_borders(const Samples& samples) {
  const Builds builds(samples);
  ordered_json out = {{"build_middle", rounded(builds.middle)}, {"build_spread", rounded(builds.spread)}};
  for (const BorderKind& kind : kBorders) add_border(kind, builds, samples, out);
  return out;
}

}  // namespace calibrate
