#include "discern_signature.hpp"

#include <cmath>
#include <cstdio>

#include <Eigen/LU>

#include <bodice/engine/executor.hpp>
#include <bodice/engine/parallel.hpp>

#include "least_squares.hpp"

namespace calibrate {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// An error of this length counts as much as odds of e to one against the true vertex; a fraction of the
/// body size.
constexpr double kErrorUnit = 0.01;
/// Steps of the descent, and the length of the first; the last is next to none.
constexpr int kSteps = 120;
constexpr double kFirstStep = 0.1;
/// How fast the descent forgets the gradients and squared gradients before.
constexpr double kForget = 0.9, kForgetSquares = 0.99;
/// What each group counts together: the few bodies of files less, the many poses of made ones more.
constexpr std::array<double, kGroupCount> kDiscernedWeights{0.3, 0.3, 1.0, 1.0, 1.5};

/// The unknowns, in deviations of the start: what is expected moves by `shift` * measures, and what is left
/// is multiplied by `upper`.
struct Unknowns {
  MatrixXd upper, shift;
};

/// A search in deviations of the start.
struct Whitened {
  std::size_t person;
  double weight, likelihood;  ///< the latter: of the true landmark's features
  VectorXd body, truth;
  MatrixXd candidates;  ///< features x candidates
  VectorXd log_weight, handicap;
  VectorXd error;  ///< what each candidate's error takes off its logarithmic weight
};

/// Measures of the body in units of their spread.
struct Scale {
  VectorXd mean, spread;

  VectorXd operator()(const VectorXd& body) const { return (body - mean).cwiseQuotient(spread); }
};

Scale scale_of(const std::vector<Search>& searches) {
  const double n = static_cast<double>(searches.size());
  const Eigen::Index size = searches.front().truth.body.size();
  Scale scale{VectorXd::Zero(size), VectorXd::Zero(size)};
  for (const Search& s : searches) scale.mean += s.truth.body / n;
  for (const Search& s : searches) scale.spread += (s.truth.body - scale.mean).cwiseAbs2() / n;
  scale.spread = scale.spread.cwiseSqrt();
  scale.mean[0] = 0.0;
  scale.spread[0] = 1.0;
  return scale;
}

Whitened whitened(const Search& search, const FittedSignature& start, const Scale& scale, const Goal& goal) {
  const auto count = static_cast<Eigen::Index>(search.candidates.size());
  Whitened w{search.person,
             0.0,
             goal.likelihood,
             scale(search.truth.body),
             start.deviations(search.truth),
             MatrixXd(start.upper.rows(), count),
             VectorXd(count),
             VectorXd(count),
             VectorXd(count)};
  for (Eigen::Index c = 0; c < count; ++c) {
    const Candidate& candidate = search.candidates[static_cast<std::size_t>(c)];
    w.candidates.col(c) = start.deviations({search.truth.body, candidate.features});
    const double error = candidate.off.norm() / kErrorUnit;
    w.log_weight[c] = std::log(candidate.area) + goal.margin * error;
    w.error[c] = (1.0 + goal.margin) * error;
    w.handicap[c] = candidate.handicap / goal.deviation;
  }
  return w;
}

/// All searches, weighed by their groups.
std::vector<Whitened> all_whitened(const std::vector<Search>& searches, const FittedSignature& start,
                                   const Scale& scale, const Goal& goal) {
  std::array<double, kGroupCount> count{};
  for (const Search& search : searches) count[static_cast<std::size_t>(search.group)] += 1.0;
  double sum = 0.0;
  for (std::size_t g = 0; g < kGroupCount; ++g) sum += count[g] > 0.0 ? kDiscernedWeights[g] : 0.0;
  std::vector<Whitened> all;
  for (const Search& search : searches) {
    const auto group = static_cast<std::size_t>(search.group);
    all.push_back(whitened(search, start, scale, goal));
    all.back().weight = kDiscernedWeights[group] / (sum * count[group]);
  }
  return all;
}

double log_sum(const VectorXd& logs) {
  const double most = logs.maxCoeff();
  return most + std::log((logs.array() - most).exp().sum());
}

/// Adds the gradient of the loss of one search. What is found is as likely as its area and its distance
/// from the signature make it; the loss is the soft least of its error and of the odds against less.
void add_discerned(const Whitened& search, const Unknowns& at, Unknowns& gradient) {
  const MatrixXd y = (at.upper * search.candidates).colwise() - at.shift * search.body;
  const VectorXd distance = y.colwise().norm().transpose();
  const VectorXd counted = (distance - search.handicap).cwiseMax(0.0);
  const VectorXd found = search.log_weight - 0.5 * counted.cwiseAbs2();
  const VectorXd right = found - search.error;
  const double all_found = log_sum(found), all_right = log_sum(right);
  const VectorXd surplus = (right.array() - all_right).exp() - (found.array() - all_found).exp();
  const VectorXd pull = search.weight * surplus.array() * counted.array() / distance.array().max(1e-9);
  const MatrixXd of_y = y * pull.asDiagonal();
  gradient.upper.noalias() += of_y * search.candidates.transpose();
  gradient.shift.noalias() -= of_y.rowwise().sum() * search.body.transpose();
}

/// The same of the likelihood of the features of the true landmark.
void add_likelihood(const Whitened& search, const Unknowns& at, Unknowns& gradient) {
  const VectorXd y = at.upper * search.truth - at.shift * search.body;
  const double weight = search.likelihood * search.weight;
  gradient.upper.noalias() += weight * y * search.truth.transpose();
  gradient.upper.diagonal() -= weight * at.upper.diagonal().cwiseInverse();
  gradient.shift.noalias() -= weight * y * search.body.transpose();
}

/// Leaves only what may differ from zero.
void restrict_to(const std::vector<bool>& odd, Unknowns& unknowns) {
  unknowns.upper.triangularView<Eigen::StrictlyLower>().setZero();
  for (Eigen::Index i = 0; i < unknowns.upper.rows(); ++i) {
    for (Eigen::Index j = 0; j < unknowns.upper.cols(); ++j)
      if (odd[static_cast<std::size_t>(i)] != odd[static_cast<std::size_t>(j)]) unknowns.upper(i, j) = 0.0;
    if (odd[static_cast<std::size_t>(i)]) unknowns.shift.row(i).setZero();
  }
}

/// One step, each unknown scaled by its own past gradients (Kingma and Ba 2015).
struct Descent {
  MatrixXd mean, square;

  void step(double length, int round, const MatrixXd& gradient, MatrixXd& unknowns) {
    mean = kForget * mean + (1.0 - kForget) * gradient;
    square = kForgetSquares * square + (1.0 - kForgetSquares) * gradient.cwiseAbs2();
    const double of_mean = 1.0 - std::pow(kForget, round), of_square = 1.0 - std::pow(kForgetSquares, round);
    unknowns.array() -= length * (mean / of_mean).array() / ((square / of_square).array().sqrt() + 1e-12);
  }
};

/// Descends by all people but those of a part; kFolds: by all.
Unknowns descend(const std::vector<Whitened>& searches, const std::vector<bool>& odd, std::size_t without) {
  const Eigen::Index n = searches.front().truth.size(), m = searches.front().body.size();
  Unknowns at{MatrixXd::Identity(n, n), MatrixXd::Zero(n, m)};
  Descent of_upper{MatrixXd::Zero(n, n), MatrixXd::Zero(n, n)};
  Descent of_shift{MatrixXd::Zero(n, m), MatrixXd::Zero(n, m)};
  for (int round = 1; round <= kSteps; ++round) {
    Unknowns gradient{MatrixXd::Zero(n, n), MatrixXd::Zero(n, m)};
    for (const Whitened& search : searches) {
      if (search.person % kFolds == without) continue;
      add_discerned(search, at, gradient);
      add_likelihood(search, at, gradient);
    }
    restrict_to(odd, gradient);
    const double length = kFirstStep * (1.0 - static_cast<double>(round - 1) / kSteps);
    of_upper.step(length, round, gradient.upper, at.upper);
    of_shift.step(length, round, gradient.shift, at.shift);
  }
  return at;
}

/// Back from deviations of the start.
FittedSignature signature_of(const Unknowns& at, const FittedSignature& start, const Scale& scale) {
  FittedSignature made{start.by_body, at.upper * start.upper};
  // The result holds upper * (x - by_body^T b) - shift * scale(b) = made.upper * (x - made.by_body^T b).
  MatrixXd of_body = at.shift * scale.spread.cwiseInverse().asDiagonal();
  of_body.col(0) -= at.shift * scale.mean.cwiseQuotient(scale.spread);
  made.by_body += made.upper.triangularView<Eigen::Upper>().solve(of_body).transpose();
  return made;
}

/// Mean and covariance of the true landmarks, and of what they are in a mirror.
FittedSignature start_of(const std::vector<Search>& searches, const std::vector<bool>& odd) {
  std::vector<SignatureRow> rows;
  for (const Search& search : searches) {
    rows.push_back(search.truth);
    if (std::ranges::find(odd, true) == odd.end()) continue;
    rows.push_back(search.truth);
    for (std::size_t i = 0; i < odd.size(); ++i)
      if (odd[i]) rows.back().features[static_cast<Eigen::Index>(i)] *= -1.0;
  }
  FittedSignature start = gaussian_signature(rows);
  for (std::size_t i = 0; i < odd.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (odd[i]) start.by_body.col(row).setZero();
    for (std::size_t j = 0; j < odd.size(); ++j)
      if (odd[i] != odd[j]) start.upper(row, static_cast<Eigen::Index>(j)) = 0.0;
  }
  start.upper = start.upper.triangularView<Eigen::Upper>();
  return start;
}

/// How far from the truth the search ends.
double found_error(const Search& search, const FittedSignature& signature) {
  constexpr double kNear = 0.05;
  std::vector<double> distance;
  for (const Candidate& c : search.candidates)
    distance.push_back(
        std::max(0.0, signature.deviations({search.truth.body, c.features}).norm() - c.handicap));
  const auto best = static_cast<std::size_t>(std::ranges::min_element(distance) - distance.begin());
  Vec3 moment = Vec3::Zero();
  double all = 0.0;
  for (std::size_t c = 0; c < distance.size(); ++c) {
    const Candidate& candidate = search.candidates[c];
    if ((candidate.off - search.candidates[best].off).norm() > kNear) continue;
    const double d = distance[c] + candidate.handicap,
                 least = distance[best] + search.candidates[best].handicap;
    const double share = candidate.area * std::exp(-0.5 * (d * d - least * least));
    moment += share * candidate.off;
    all += share;
  }
  return (moment / all).norm();
}

/// Prints mean and worst error of each group in percent of the body size.
void print_errors(const char* what, const std::vector<Search>& searches, const FittedSignature& signature) {
  std::array<double, kGroupCount> sum{}, count{}, worst{};
  for (const Search& search : searches) {
    const auto group = static_cast<std::size_t>(search.group);
    const double error = found_error(search, signature);
    sum[group] += error;
    count[group] += 1.0;
    worst[group] = std::max(worst[group], error);
  }
  std::printf("    %-16s", what);
  for (std::size_t g = 0; g < kGroupCount; ++g)
    std::printf(" %6.2f %5.2f", 100.0 * sum[g] / std::max(count[g], 1.0), 100.0 * worst[g]);
  std::printf("\n");
}

}  // namespace

FittedSignature discern_signature(const std::vector<Search>& searches, const Goal& goal) {
  const FittedSignature start = start_of(searches, goal.odd);
  const Scale scale = scale_of(searches);
  const std::vector<Whitened> all = all_whitened(searches, start, scale, goal);
  constexpr std::array kWithout{kFolds, std::size_t{0}};
  std::array<FittedSignature, kWithout.size()> made;
  const auto workers = bodice::engine::make_tbb_executor();
  const bodice::engine::Context context{.executor = workers.get()};
  bodice::engine::parallel_for(context, made.size(), 1, [&](std::size_t i, std::size_t) {
    made[i] = signature_of(descend(all, goal.odd, kWithout[i]), start, scale);
    made[i].upper *= goal.deviation;
  });
  std::vector<Search> left_out;
  for (const Search& search : searches)
    if (search.person % kFolds == kWithout[1]) left_out.push_back(search);
  std::printf("  %zu searches, %zu of them of people to leave out\n", searches.size(), left_out.size());
  print_errors("start", searches, start);
  print_errors("discerned", searches, made[0]);
  print_errors("to leave out", left_out, made[0]);
  print_errors("left out", left_out, made[1]);
  return made[0];
}

}  // namespace calibrate
