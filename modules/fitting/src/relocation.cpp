#include "relocation.hpp"

#include <algorithm>
#include <numeric>

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;

constexpr double kWorthwhile = 0.5;  // of a costly ellipsoid's cost: what a second one may save
constexpr int kBarredRounds = 12;
constexpr int kFirstMoves = 12;  // one ellipsoid in so many

std::vector<std::size_t> ascending(const std::vector<double>& value) {
  std::vector<std::size_t> order(value.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return value[a] < value[b]; });
  return order;
}

/// Two ellipsoids over the halves of one along its longest axis.
void split(Ellipsoid& e, Ellipsoid& twin) {
  int longest = 0;
  e.radii.maxCoeff(&longest);
  const Vec3 half = 0.5 * e.radii[longest] * e.axes.col(longest);
  e.radii[longest] *= 0.6;
  twin = e;
  e.center += half;
  twin.center -= half;
}

}  // namespace

Relocation::Relocation(std::size_t ellipsoids)
    : moves_(std::max(1, static_cast<int>(ellipsoids) / kFirstMoves)), barred_until_(ellipsoids, 0) {}

std::vector<std::size_t> Relocation::move(const TightProblem& problem, std::vector<Ellipsoid>& ellipsoids) {
  ++round_;
  last_.clear();
  const std::vector<double> cost = problem.cost_of_each(), use = problem.use_of_each();
  const std::vector<std::size_t> by_cost = ascending(cost), by_use = ascending(use);
  std::vector<bool> taken(cost.size(), false);
  std::vector<std::size_t> changed;
  auto idle = by_use.begin();
  for (auto costly = by_cost.rbegin(); costly != by_cost.rend() && static_cast<int>(last_.size()) < moves_;
       ++costly) {
    if (taken[*costly] || barred_until_[*costly] > round_) continue;
    while (idle != by_use.end() && (taken[*idle] || *idle == *costly)) ++idle;
    if (idle == by_use.end() || use[*idle] > kWorthwhile * cost[*costly]) break;
    taken[*costly] = taken[*idle] = true;
    split(ellipsoids[*costly], ellipsoids[*idle]);
    last_.push_back({*idle, *costly});
    changed.insert(changed.end(), {*idle, *costly});
  }
  return changed;
}

void Relocation::judge(bool paid) {
  if (paid) return;
  if (last_.size() == 1) barred_until_[last_[0].costly] = round_ + kBarredRounds;
  moves_ = std::max(1, static_cast<int>(last_.size()) / 2);
}

}  // namespace bodice::fitting
