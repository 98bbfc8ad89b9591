#include "fit_corrections.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include <bodice/engine/executor.hpp>
#include <bodice/engine/parallel.hpp>

#include "least_squares.hpp"

namespace calibrate {
namespace {

using bodice::anatomy::Correction;
using bodice::anatomy::CorrectionAxis;
using bodice::anatomy::CorrectionRecords;
using bodice::anatomy::LandmarkKind;
using bodice::anatomy::TrialCoefficients;
using bodice::body::LandmarkId;

/// What a squared weight may cost, as a share of a row in units of its measure's spread.
constexpr std::array kRidges{1e-5, 1e-4, 1e-3};
/// A first estimate that is so many times as far off as a correction may move lies somewhere else on the
/// body.
constexpr double kElsewhere = 2.0;
/// Errors below this count by their square, larger ones by their length; fractions of the body size. Where
/// weights are many, means are small already, and few large errors matter more.
constexpr double kSmallError = 0.002, kSmallWhereMany = 0.02;

/// What the mean error of each group counts.
using GroupWeights = std::array<double, kGroupCount>;
/// A correction of many weights could follow the few bodies of files one by one: there they count less, and
/// the made ones in their many poses more.
constexpr GroupWeights kWeights{1.75, 1.5, 1.0, 1.0, 1.0}, kWeightsWhereMany{0.3, 0.3, 1.0, 1.0, 1.5};
constexpr Eigen::Index kManyWeights = 30;

/// One correction of a landmark, by the left one of a pair.
struct Stage {
  const LandmarkKind* kind;
  std::string members;  ///< those of all axes
};

/// One correction of one body; lengths are fractions of the body size.
struct Row {
  std::size_t person;
  Group group;
  const Correction* correction;
  Vec3 missing;                                      ///< from the first estimate to the true landmark
  Eigen::Matrix<double, 3, Eigen::Dynamic> factors;  ///< what unknowns are multiplied by
  double weight = 0.0;
};

/// The same correction of all bodies.
using Rows = std::vector<Row>;
using AllRecords = std::vector<CorrectionRecords>;

AllRecords measure(const Samples& samples, const TrialCoefficients& trial) {
  AllRecords records(samples.size());
  const auto workers = bodice::engine::make_tbb_executor();
  const bodice::engine::Context context{.executor = workers.get()};
  bodice::engine::parallel_for(context, samples.size(), 1,
                               [&](std::size_t i, std::size_t) { records[i] = samples[i]->records(trial); });
  return records;
}

bool is_of(const LandmarkKind& kind, LandmarkId id) {
  return id == kind.id || (kind.paired && id == bodice::body::of_side(kind.id, 1));
}

std::size_t weight_count(const CorrectionAxis& axis) {
  return axis.measures.size() + (axis.odd ? 0 : 1);
}

std::string members_of(const Correction& correction) {
  std::string members;
  for (const CorrectionAxis& axis : correction.axes) members += std::string(axis.weights.member) + " ";
  return members;
}

/// All corrections of these landmarks in the order in which a body applies them.
std::vector<Stage> stages_of(const std::vector<const LandmarkKind*>& kinds, const AllRecords& records) {
  std::vector<Stage> longest;
  for (const CorrectionRecords& of_body : records) {
    std::vector<Stage> stages;
    for (const Correction& correction : of_body.corrections)
      for (const LandmarkKind* kind : kinds)
        if (kind->id == correction.of) stages.push_back({kind, members_of(correction)});
    if (stages.size() > longest.size()) longest = stages;
  }
  return longest;
}

/// What the unknowns of all axes are multiplied by: direction[k] * (1, measures).
Eigen::Matrix<double, 3, Eigen::Dynamic> factors(const Correction& correction) {
  std::vector<double> all;
  std::vector<Vec3> directions;
  for (const CorrectionAxis& axis : correction.axes) {
    if (!axis.odd) all.push_back(1.0);
    all.insert(all.end(), axis.measures.begin(), axis.measures.end());
    directions.resize(all.size(), axis.direction);
  }
  Eigen::Matrix<double, 3, Eigen::Dynamic> result(3, static_cast<Eigen::Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i)
    result.col(static_cast<Eigen::Index>(i)) = all[i] * directions[i];
  return result;
}

/// Weighs the groups, and all rows together as many as there are.
void weigh(Rows& rows) {
  const bool many = rows.front().factors.cols() > kManyWeights;
  const GroupWeights& of_group = many ? kWeightsWhereMany : kWeights;
  std::array<double, kGroupCount> count{};
  for (const Row& row : rows) count[static_cast<std::size_t>(row.group)] += 1.0;
  double sum = 0.0;
  for (Row& row : rows) {
    const auto group = static_cast<std::size_t>(row.group);
    sum += row.weight = of_group[group] / count[group];
  }
  for (Row& row : rows) row.weight *= static_cast<double>(rows.size()) / sum;
}

Rows rows_of(const Stage& stage, const Samples& samples, const AllRecords& records) {
  Rows rows;
  for (std::size_t body = 0; body < samples.size(); ++body)
    for (const Correction& correction : records[body].corrections) {
      if (!is_of(*stage.kind, correction.of) || !samples[body]->knows(correction.of)) continue;
      if (members_of(correction) != stage.members) continue;
      const Vec3 missing =
          (samples[body]->landmark(correction.of) - correction.first) / samples[body]->size_m();
      if (!missing.allFinite() || missing.norm() > kElsewhere * correction.most) continue;
      rows.push_back(
          {samples[body]->person(), samples[body]->group(), &correction, missing, factors(correction)});
      if (!rows.back().factors.allFinite()) rows.pop_back();
    }
  weigh(rows);
  return rows;
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

/// How far from the true landmark the weights lead.
double error(const Row& row, const Eigen::VectorXd& weights) {
  return (row.missing - row.factors * weights).norm();
}

/// The weights of the least sum of errors by all people but those of a part; kFolds: by all. Squares that
/// count the less, the larger the error was the round before, lead there.
Eigen::VectorXd solve(const Rows& rows, const Eigen::VectorXd& ridge, std::size_t without = kFolds) {
  const double small = rows.front().factors.cols() > kManyWeights ? kSmallWhereMany : kSmallError;
  Eigen::VectorXd weights;
  for (int round = 0; round < kReweighted; ++round) {
    LeastSquares system(static_cast<int>(ridge.size()));
    for (const Row& row : rows) {
      if (row.person % kFolds == without) continue;
      const double w = round == 0 ? row.weight : row.weight / std::max(error(row, weights), small);
      for (int k = 0; k < 3; ++k) system.add(row.factors.row(k).transpose(), row.missing[k], w);
    }
    weights = system.solve(ridge).col(0);
  }
  return weights;
}

/// Mean errors of the groups.
using ByGroup = std::array<double, kGroupCount>;

/// `error_of` (row).
template <class ErrorOf>
ByGroup mean_errors(const Rows& rows, ErrorOf&& error_of) {
  ByGroup sum{}, count{};
  for (const Row& row : rows) {
    sum[static_cast<std::size_t>(row.group)] += error_of(row);
    count[static_cast<std::size_t>(row.group)] += 1.0;
  }
  for (std::size_t g = 0; g < kGroupCount; ++g) sum[g] /= std::max(count[g], 1.0);
  return sum;
}

/// The mean errors of people that are left out.
ByGroup left_out_errors(const Rows& rows, const Eigen::VectorXd& ridge) {
  std::vector<Eigen::VectorXd> weights;
  for (std::size_t fold = 0; fold < kFolds; ++fold) weights.push_back(solve(rows, ridge, fold));
  return mean_errors(rows, [&](const Row& row) { return error(row, weights[row.person % kFolds]); });
}

double total(const ByGroup& errors) {
  return std::accumulate(errors.begin(), errors.end(), 0.0);
}

void print_errors(const char* what, const ByGroup& errors) {
  std::printf("    %-16s", what);
  for (const double e : errors) std::printf(" %6.2f", 100.0 * e);
  std::printf("\n");
}

/// Fits one correction, and puts it on trial.
void fit_stage(const Stage& stage, const Rows& rows, TrialCoefficients& trial, ordered_json& out) {
  double ridge = 0.0;
  ByGroup best;
  best.fill(std::numeric_limits<double>::infinity());
  const Eigen::VectorXd costs = spreads(rows).cwiseAbs2();
  for (const double candidate : kRidges) {
    const ByGroup left = left_out_errors(rows, candidate * costs);
    if (total(left) < total(best)) best = left, ridge = candidate;
  }
  const Eigen::VectorXd weights = solve(rows, ridge * costs);
  std::printf("  %s, %s: %zu rows, ridge %g\n", std::string(bodice::body::name(stage.kind->id)).c_str(),
              stage.members.c_str(), rows.size(), ridge);
  print_errors("first estimate", mean_errors(rows, [](const Row& row) { return row.missing.norm(); }));
  print_errors("corrected", mean_errors(rows, [&](const Row& row) { return error(row, weights); }));
  print_errors("left-out people", best);
  Eigen::Index at = 0;
  for (const CorrectionAxis& axis : rows.front().correction->axes) {
    const auto count = static_cast<Eigen::Index>(weight_count(axis));
    Eigen::VectorXd of_axis = Eigen::VectorXd::Zero(count + (axis.odd ? 1 : 0));
    of_axis.tail(count) = weights.segment(at, count);
    out[axis.weights.member] = rounded(of_axis);
    const auto values = out[axis.weights.member].get<std::vector<double>>();
    for (int side = 0; side < (stage.kind->paired ? 2 : 1); ++side)
      trial[{bodice::body::of_side(stage.kind->id, side), axis.weights.member}] = values;
    at += count;
  }
}

/// The least and the most of what all bodies measure; the most alone where limits are symmetric.
void add_limits(const LandmarkKind& kind, const AllRecords& records, ordered_json& out) {
  std::map<std::string, Eigen::VectorXd> found;
  for (const CorrectionRecords& of_body : records)
    for (const auto& [of, limits, measures] : of_body.measured) {
      if (!is_of(kind, of)) continue;
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

std::map<const LandmarkKind*, ordered_json> fit_corrections(const std::vector<const LandmarkKind*>& kinds,
                                                            const Samples& samples) {
  std::map<const LandmarkKind*, ordered_json> made;
  TrialCoefficients trial;
  AllRecords records = measure(samples, trial);
  for (const Stage& stage : stages_of(kinds, records)) {
    fit_stage(stage, rows_of(stage, samples, records), trial, made[stage.kind]);
    records = measure(samples, trial);
  }
  for (auto& [kind, coefficients] : made) add_limits(*kind, records, coefficients);
  return made;
}

}  // namespace calibrate
