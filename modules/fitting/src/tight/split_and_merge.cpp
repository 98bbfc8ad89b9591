// Based on: Naonori Ueda, Ryohei Nakano, Zoubin Ghahramani, Geoffrey Hinton. SMEM algorithm for mixture
// models. 2000. (a split and a merge at once, tried with all other components fixed)
// Differs: the cost is that of least squares. Splits and removals of all ellipsoids and merges of all
// neighbors are tried, and all moves that do not touch each other are made at once.
#include "tight/split_and_merge.hpp"

#include <algorithm>
#include <numeric>

#include <Eigen/Eigenvalues>

#include <bodice/engine/parallel.hpp>

#include "tight/local_fit.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

using geometry::Ellipsoid;
using Partners = std::vector<std::vector<std::uint32_t>>;

constexpr std::size_t kPartners = 3;  // merges are tried with so many neighbors
constexpr int kFirstSteps = 4,
              kLastSteps = 6;    // steps of a trial; the first decide whether the last are taken
constexpr double kNoGain = 1.0;  // a merge is given up if it costs more than this times the best split's gain

/// The second nearest ellipsoids of each ellipsoid's own samples.
struct Neighbors {
  std::vector<std::size_t> first;     ///< #E + 1, into `second`
  std::vector<std::uint32_t> second;  ///< one a sample that has two candidates, in groups by its nearest
};

Neighbors neighbors_of(std::span<const Nearest3> ranked, std::size_t count) {
  Neighbors found{std::vector<std::size_t>(count + 1, 0), {}};
  for (const auto& [k, at] : ranked)
    if (k[1] < count) ++found.first[k[0] + 1];
  std::partial_sum(found.first.begin(), found.first.end(), found.first.begin());
  found.second.resize(found.first.back());
  std::vector<std::size_t> next = found.first;
  for (const auto& [k, at] : ranked)
    if (k[1] < count) found.second[next[k[0]]++] = k[1];
  return found;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> frequent_neighbors(std::span<const Nearest3> ranked,
                                                           std::size_t count) {
  const Neighbors all = neighbors_of(ranked, count);
  std::vector<std::uint32_t> votes(count, 0);  // used for one ellipsoid at a time, and then reset to zeros
  Partners found(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto mine = std::span(all.second).subspan(all.first[k], all.first[k + 1] - all.first[k]);
    for (const std::uint32_t other : mine)
      if (votes[other]++ == 0) found[k].push_back(other);
    const auto most = found[k].begin() + static_cast<std::ptrdiff_t>(std::min(kPartners, found[k].size()));
    std::partial_sort(found[k].begin(), most, found[k].end(), [&](std::uint32_t a, std::uint32_t b) {
      return votes[a] != votes[b] ? votes[a] > votes[b] : a < b;
    });
    for (const std::uint32_t other : mine) votes[other] = 0;
    found[k].erase(most, found[k].end());
  }
  return found;
}

namespace {

/// A trial: what replaces one ellipsoid, or two in a merge.
struct Trial {
  std::uint32_t first = 0, second = 0;  ///< the replaced ellipsoids; equal if there is one
  double rise = 0.0;                    ///< rise of the cost
  std::vector<Ellipsoid> found;         ///< two in a split, one in a merge, none in a removal
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

/// The ellipsoid with the mean and the covariance of the volume of both. A solid ellipsoid has covariance
/// diag(r^2) / 5.
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
  e.radii =
      (5.0 * eigen.eigenvalues()).cwiseMax(0.0).cwiseSqrt();  // no radius is below the least one of both
  return e;
}

void sort_by_rise(std::vector<Trial>& trials) {
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.rise < b.rise; });
}

/// Trials with single ellipsoids: the splits that lower the cost, best first, and #E removals.
struct OneByOne {
  std::vector<Trial> splits, removals;
};

OneByOne try_each(const engine::Context& context, const LeastSquaresProblem& problem,
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

std::vector<Trial> try_merges(const engine::Context& context, const LeastSquaresProblem& problem,
                              std::span<const Nearest3> ranked, const Partners& partners,
                              const std::vector<Ellipsoid>& ellipsoids, double most_rise) {
  std::vector<Trial> merges;
  for (std::uint32_t k = 0; k < partners.size(); ++k)
    for (const std::uint32_t other : partners[k]) {
      const bool is_mutual = std::ranges::find(partners[other], k) != partners[other].end();
      if (k < other || !is_mutual) merges.push_back({std::min(k, other), std::max(k, other), 0.0, {}});
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

std::vector<std::size_t> split_and_merge(const engine::Context& context, const LeastSquaresProblem& problem,
                                         std::vector<Ellipsoid>& ellipsoids) {
  const std::vector<Nearest3> ranked = problem.rank(context);
  const auto [splits, removals] = try_each(context, problem, ranked, ellipsoids);
  if (splits.empty()) return {};
  const Partners partners = frequent_neighbors(ranked, ellipsoids.size());
  std::vector<Trial> merges =
      try_merges(context, problem, ranked, partners, ellipsoids, -kNoGain * splits.front().rise);
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
