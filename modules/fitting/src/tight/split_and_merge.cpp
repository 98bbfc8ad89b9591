// Based on: Naonori Ueda, Ryohei Nakano, Zoubin Ghahramani, Geoffrey Hinton. SMEM algorithm for mixture
// models. 2000 (splits and merges at once, tried with all other components fixed). Differs: least squares;
// every ellipsoid's split and removal and every pair of neighbors' merge is tried; as many moves are made at
// once as do not touch each other.
#include "tight/split_and_merge.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include <bodice/engine/parallel.hpp>

#include "tight/local_fit.hpp"

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;
using Partners = std::vector<std::vector<std::uint32_t>>;

constexpr std::size_t kPartners = 3;
constexpr int kFirstSteps = 4, kLastSteps = 6;  // of a trial; the first tell which trials are worth the last
constexpr double kHopeless = 1.0;  // times the most that any split gains: a merge that costs more is left

/// #E x up to kPartners: who is second nearest to an ellipsoid's samples, the most frequent first.
Partners partners_of(std::span<const Nearest3> ranked, std::size_t count) {
  std::vector<std::uint32_t> votes(count * count, 0);
  for (const auto& [k, at] : ranked)
    if (k[1] < count) ++votes[k[0] * count + k[1]];
  Partners found(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto mine = std::span(votes).subspan(k * count, count);
    for (std::uint32_t other = 0; other < count; ++other)
      if (mine[other] > 0) found[k].push_back(other);
    std::ranges::stable_sort(found[k], std::ranges::greater{},
                             [&](std::uint32_t other) { return mine[other]; });
    if (found[k].size() > kPartners) found[k].resize(kPartners);
  }
  return found;
}

/// What has been tried in place of one ellipsoid (then it is `second`, too) or of two.
struct Trial {
  std::uint32_t first = 0, second = 0;
  double rise = 0.0;             ///< of the cost
  std::vector<Ellipsoid> found;  ///< two of a split, one of a merge, none if one goes without
};

/// Two ellipsoids over the halves of one along an axis.
std::vector<Ellipsoid> halves(Ellipsoid e, int axis) {
  const Vec3 half = 0.5 * e.radii[axis] * e.axes.col(axis);
  e.radii[axis] *= 0.6;
  Ellipsoid twin = e;
  e.center += half;
  twin.center -= half;
  return {e, twin};
}

/// One ellipsoid with the volume's mean and covariance of both. (A solid ellipsoid has covariance diag(r^2)
/// / 5.)
Ellipsoid merged(const Ellipsoid& a, const Ellipsoid& b) {
  const double of_a = a.radii.prod() / (a.radii.prod() + b.radii.prod());
  Ellipsoid e;
  e.center = of_a * a.center + (1.0 - of_a) * b.center;
  const auto moment = [&](const Ellipsoid& part) -> geometry::Mat3 {
    const Vec3 off = part.center - e.center;
    return part.axes * (0.2 * part.radii.cwiseAbs2()).asDiagonal() * part.axes.transpose() +
           off * off.transpose();
  };
  const Eigen::SelfAdjointEigenSolver<geometry::Mat3> eigen(of_a * moment(a) + (1.0 - of_a) * moment(b));
  e.axes = eigen.eigenvectors();
  if (e.axes.determinant() < 0.0) e.axes.col(2) = -e.axes.col(2);
  e.radii = (5.0 * eigen.eigenvalues()).cwiseMax(0.0).cwiseSqrt();  // none below the least of both
  return e;
}

void sort_by_rise(std::vector<Trial>& trials) {
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.rise < b.rise; });
}

/// #E splits and #E removals.
struct OneByOne {
  std::vector<Trial> splits, removals;
};

OneByOne try_each(const engine::Context& context, const TightProblem& problem,
                  std::span<const Nearest3> ranked, const std::vector<Ellipsoid>& ellipsoids) {
  const std::size_t count = ellipsoids.size();
  OneByOne tried{std::vector<Trial>(count), std::vector<Trial>(count)};
  engine::parallel_for(context, count, 1, [&](std::size_t i, std::size_t) {
    const auto k = static_cast<std::uint32_t>(i);
    const Neighborhood samples = problem.around({&k, 1}, ranked);
    tried.removals[i] = {k, k, LocalFit(samples, problem.loss(), {}).rise(), {}};
    std::vector<LocalFit> along;
    along.reserve(3);
    for (int axis = 0; axis < 3; ++axis) {
      along.emplace_back(samples, problem.loss(), halves(ellipsoids[k], axis));
      along.back().advance(kFirstSteps);
    }
    LocalFit& best = *std::ranges::min_element(along, {}, &LocalFit::rise);
    best.advance(kLastSteps);
    tried.splits[i] = {k, k, best.rise(), best.ellipsoids()};
  });
  std::erase_if(tried.splits, [](const Trial& split) { return split.rise >= 0.0; });
  sort_by_rise(tried.splits);
  return tried;
}

std::vector<Trial> try_merges(const engine::Context& context, const TightProblem& problem,
                              std::span<const Nearest3> ranked, const Partners& partners,
                              const std::vector<Ellipsoid>& ellipsoids, double most_rise) {
  std::vector<Trial> merges;
  for (std::uint32_t k = 0; k < partners.size(); ++k)
    for (const std::uint32_t other : partners[k]) {
      const bool told_twice = std::ranges::find(partners[other], k) != partners[other].end();
      if (k < other || !told_twice) merges.push_back({std::min(k, other), std::max(k, other), 0.0, {}});
    }
  engine::parallel_for(context, merges.size(), 1, [&](std::size_t i, std::size_t) {
    Trial& merge = merges[i];
    const std::uint32_t both[] = {merge.first, merge.second};
    const Neighborhood samples = problem.around(both, ranked);
    LocalFit fit(samples, problem.loss(), {merged(ellipsoids[merge.first], ellipsoids[merge.second])});
    fit.advance(kFirstSteps);
    if (fit.rise() < most_rise) fit.advance(kLastSteps);
    merge.rise = fit.rise();
    merge.found = fit.ellipsoids();
  });
  return merges;
}

}  // namespace

std::vector<std::size_t> relocate(const engine::Context& context, const TightProblem& problem,
                                  std::vector<Ellipsoid>& ellipsoids) {
  const std::vector<Nearest3> ranked = problem.rank(context);
  const auto [splits, removals] = try_each(context, problem, ranked, ellipsoids);
  if (splits.empty()) return {};
  const Partners partners = partners_of(ranked, ellipsoids.size());
  std::vector<Trial> merges =
      try_merges(context, problem, ranked, partners, ellipsoids, -kHopeless * splits.front().rise);
  merges.insert(merges.end(), removals.begin(), removals.end());
  sort_by_rise(merges);
  std::vector<bool> taken(ellipsoids.size(), false);
  std::vector<std::size_t> changed;
  const auto take = [&](std::uint32_t k) {
    changed.push_back(k);
    taken[k] = true;
    if (!partners[k].empty()) taken[partners[k].front()] = true;
  };
  for (const Trial& split : splits) {
    if (taken[split.first]) continue;
    const auto& beside = partners[split.first];
    const auto meets = [&](std::uint32_t k) {
      return taken[k] || k == split.first || std::ranges::find(beside, k) != beside.end();
    };
    const auto merge =
        std::ranges::find_if(merges, [&](const Trial& m) { return !meets(m.first) && !meets(m.second); });
    if (merge == merges.end() || split.rise + merge->rise >= 0.0) continue;
    if (!merge->found.empty()) ellipsoids[merge->first] = merge->found[0];
    ellipsoids[split.first] = split.found[0];
    ellipsoids[merge->second] = split.found[1];
    for (const std::uint32_t k : {merge->first, split.first, merge->second}) take(k);
  }
  return changed;
}

}  // namespace bodice::fitting
