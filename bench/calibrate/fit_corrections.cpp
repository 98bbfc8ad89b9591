#include "fit_corrections.hpp"

#include <cmath>
#include <cstdio>
#include <map>

#include "least_squares.hpp"

namespace calibrate {
namespace {

using bodice::anatomy::Correction;
using bodice::anatomy::CorrectionAxis;
using bodice::anatomy::LandmarkKind;

/// What a squared weight may cost, as a share of a row in units of its measure's spread.
constexpr std::array kRidges{1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
/// A first estimate that is so many times as far off as a correction may move lies somewhere else on the
/// body.
constexpr double kElsewhere = 2.0;

/// One correction of one body, in fractions of the body size.
struct Row {
  std::size_t person;
  const Correction* correction;
  Vec3 missing;  ///< from the first estimate to the true landmark
};

/// The same correction of all bodies.
using Rows = std::vector<Row>;

std::size_t weight_count(const CorrectionAxis& axis) {
  return axis.measures.size() + (axis.odd ? 0 : 1);
}

std::string name_of(const Correction& correction) {
  std::string name;
  for (const CorrectionAxis& axis : correction.axes) name += std::string(axis.weights.member) + " ";
  return name;
}

/// The rows of each correction of a landmark.
std::map<std::string, Rows> rows_of(const LandmarkKind& kind, const Samples& samples) {
  std::map<std::string, Rows> rows;
  for (std::size_t body = 0; body < samples.size(); ++body)
    for (const Correction& correction : samples[body]->records().corrections) {
      const bool left = correction.of == kind.id;
      const bool right = kind.paired && correction.of == bodice::body::of_side(kind.id, 1);
      if ((!left && !right) || !samples[body]->knows(correction.of)) continue;
      const Vec3 missing =
          (samples[body]->landmark(correction.of) - correction.first) / samples[body]->size_m();
      if (!missing.allFinite() || missing.norm() > kElsewhere * correction.most) continue;
      rows[name_of(correction)].push_back({samples[body]->person(), &correction, missing});
    }
  return rows;
}

/// The unknowns' factors in coordinate k of a row: direction[k] * (1, measures), axis after axis.
Eigen::VectorXd factors(const Correction& correction, int k) {
  std::vector<double> all;
  for (const CorrectionAxis& axis : correction.axes) {
    if (!axis.odd) all.push_back(axis.direction[k]);
    for (const double m : axis.measures) all.push_back(axis.direction[k] * m);
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

/// The spread of each measure over the rows; 0 for the constants, which cost nothing.
Eigen::VectorXd spreads(const Rows& rows) {
  std::vector<double> all;
  const Correction& first = *rows.front().correction;
  for (std::size_t a = 0; a < first.axes.size(); ++a) {
    if (!first.axes[a].odd) all.push_back(0.0);
    for (std::size_t m = 0; m < first.axes[a].measures.size(); ++m) {
      double sum = 0.0, square = 0.0;
      for (const Row& row : rows) {
        const double value = row.correction->axes[a].measures[m];
        sum += value;
        square += value * value;
      }
      const double n = static_cast<double>(rows.size()), mean = first.axes[a].odd ? 0.0 : sum / n;
      all.push_back(std::sqrt(std::max(0.0, square / n - mean * mean)));
    }
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

/// The equations of all rows, by parts of the people.
FoldedLeastSquares equations_of(const Rows& rows) {
  FoldedLeastSquares equations(static_cast<int>(factors(*rows.front().correction, 0).size()));
  for (const Row& row : rows)
    for (int k = 0; k < 3; ++k) equations.add(row.person, factors(*row.correction, k), row.missing[k]);
  return equations;
}

/// How far from the true landmark the weights lead.
double error(const Row& row, const Eigen::VectorXd& weights) {
  Vec3 left = row.missing;
  for (int k = 0; k < 3; ++k) left[k] -= factors(*row.correction, k).dot(weights);
  return left.norm();
}

/// The mean error of people that are left out.
double left_out_error(const Rows& rows, const FoldedLeastSquares& equations, const Eigen::VectorXd& ridge) {
  std::vector<Eigen::VectorXd> weights;
  for (std::size_t fold = 0; fold < kFolds; ++fold) weights.push_back(equations.solve(ridge, fold));
  double sum = 0.0;
  for (const Row& row : rows) sum += error(row, weights[row.person % kFolds]);
  return sum / static_cast<double>(rows.size());
}

void add_weights(const Rows& rows, ordered_json& out) {
  double best = std::numeric_limits<double>::infinity(), ridge = 0.0, before = 0.0;
  const FoldedLeastSquares equations = equations_of(rows);
  const Eigen::VectorXd costs = spreads(rows).cwiseAbs2();
  for (const double candidate : kRidges) {
    const double left = left_out_error(rows, equations, candidate * costs);
    if (left < best) best = left, ridge = candidate;
  }
  for (const Row& row : rows) before += row.missing.norm() / static_cast<double>(rows.size());
  const Correction& first = *rows.front().correction;
  std::printf(
      "  %s: %zu rows, first estimate %.2f %%, left-out people %.2f %% of the body size off, ridge %g\n",
      name_of(first).c_str(), rows.size(), 100.0 * before, 100.0 * best, ridge);
  const Eigen::VectorXd weights = equations.solve(Eigen::VectorXd(ridge * costs));
  Eigen::Index at = 0;
  for (const CorrectionAxis& axis : first.axes) {
    const auto count = static_cast<Eigen::Index>(weight_count(axis));
    Eigen::VectorXd of_axis = Eigen::VectorXd::Zero(count + (axis.odd ? 1 : 0));
    of_axis.tail(count) = weights.segment(at, count);
    out[axis.weights.member] = rounded(of_axis);
    at += count;
  }
}

/// The least and the most of what all bodies measure; the most alone where limits are symmetric.
void add_limits(const LandmarkKind& kind, const Samples& samples, ordered_json& out) {
  std::map<std::string, Eigen::VectorXd> found;
  for (const auto& sample : samples)
    for (const auto& [of, limits, measures] : sample->records().measured) {
      if (of != kind.id && !(kind.paired && of == bodice::body::of_side(kind.id, 1))) continue;
      const Eigen::VectorXd x =
          Eigen::Map<const Eigen::VectorXd>(measures.data(), static_cast<Eigen::Index>(measures.size()));
      if (!x.allFinite()) continue;
      const bool symmetric = *limits.least.member == '\0';
      auto& most = found.try_emplace(limits.most.member, x).first->second;
      most = most.cwiseMax(symmetric ? Eigen::VectorXd(x.cwiseAbs()) : x);
      if (symmetric) continue;
      auto& least = found.try_emplace(limits.least.member, x).first->second;
      least = least.cwiseMin(x);
    }
  for (const auto& [member, limits] : found) out[member] = rounded(limits);
}

}  // namespace

ordered_json fit_corrections(const LandmarkKind& kind, const Samples& samples) {
  ordered_json coefficients = ordered_json::object();
  for (const auto& [name, rows] : rows_of(kind, samples)) add_weights(rows, coefficients);
  add_limits(kind, samples, coefficients);
  return coefficients;
}

}  // namespace calibrate
