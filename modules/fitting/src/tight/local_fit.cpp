#include "tight/local_fit.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/vector_clones.hpp"
#include "tight/damped_step.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

using geometry::Ellipsoid;

/// Two samples an unknown: an ellipsoid with fewer of them is not moved, because it might go anywhere.
constexpr std::size_t kLeastSamples = 18;
constexpr double kMostMotion = 0.03;   // longest step, in the scaled body
constexpr std::size_t kFitLanes = 16;  // each lane has its own sum, so that vector code adds in a fixed order

}  // namespace

BODICE_CLONES static void lower(std::size_t n, std::uint32_t ellipsoid, const float* __restrict d,
                                float* __restrict least, std::uint32_t* __restrict owner) {
  for (std::size_t i = 0; i < n; ++i) {
    owner[i] = d[i] < least[i] ? ellipsoid : owner[i];
    least[i] = d[i] < least[i] ? d[i] : least[i];
  }
}

BODICE_CLONES static void add_up(std::size_t n, const float* __restrict cost, double* __restrict lanes) {
  for (std::size_t first = 0; first + kFitLanes <= n; first += kFitLanes)
    for (std::size_t lane = 0; lane < kFitLanes; ++lane)
      lanes[lane] += static_cast<double>(cost[first + lane]);
}

void Neighborhood::resize(std::size_t count) {
  for (auto* v : {&x, &y, &z, &target, &others}) v->resize(count);
  one_sided.resize(count);
}

LocalFit::LocalFit(const Neighborhood& samples, const RobustLoss& loss, std::vector<Ellipsoid> ellipsoids)
    : samples_(samples), loss_(loss), ellipsoids_(std::move(ellipsoids)), damping_(kFirstDamping) {
  const std::size_t n = samples.x.size();
  for (Assignment* made : {&now_, &before_}) {
    made->least.resize(n), made->owner.resize(n), made->cost.resize(n);
  }
  distance_.resize(n);
  cost_ = evaluate(ellipsoids_);
}

double LocalFit::evaluate(const std::vector<Ellipsoid>& ellipsoids) {
  const std::size_t n = samples_.x.size();
  std::ranges::copy(samples_.others, now_.least.begin());
  std::ranges::fill(now_.owner, static_cast<std::uint32_t>(ellipsoids.size()));
  for (std::uint32_t e = 0; e < ellipsoids.size(); ++e) {
    batch_distances(FloatEllipsoid(ellipsoids[e]),
                    {n, samples_.x.data(), samples_.y.data(), samples_.z.data()}, distance_.data());
    lower(n, e, distance_.data(), now_.least.data(), now_.owner.data());
  }
  count_costs(loss_, n, samples_.target.data(), samples_.one_sided.data(), now_.least.data(),
              now_.cost.data());
  double lanes[kFitLanes] = {};
  add_up(n, now_.cost.data(), lanes);
  double cost = std::accumulate(std::begin(lanes), std::end(lanes), 0.0);
  for (std::size_t i = n - n % kFitLanes; i < n; ++i) cost += static_cast<double>(now_.cost[i]);
  return cost;
}

NormalBlock LocalFit::normal_equations(std::size_t e) {
  const std::size_t n = now_.owner.size();
  const std::uint32_t* const owner = now_.owner.data();
  const float* const cost = now_.cost.data();
  const auto picked =
      pick(n, mine_.picked, [=](std::size_t i) { return (owner[i] == e) & (cost[i] > 0.0f); });
  if (picked.size() < kLeastSamples) return {};
  mine_.start(picked.size());
  for (const std::uint32_t i : picked)
    mine_.add(samples_.x[i], samples_.y[i], samples_.z[i], samples_.target[i], now_.least[i]);
  mine_.weigh(loss_);
  return normal_block(ellipsoids_[e], mine_);
}

void LocalFit::advance(int steps) {
  for (int step = 0; step < steps; ++step) {
    std::vector<Ellipsoid> next;
    for (std::size_t e = 0; e < ellipsoids_.size(); ++e)
      next.push_back(damped_step(ellipsoids_[e], normal_equations(e), damping_, kMostMotion).ellipsoid);
    std::swap(now_, before_);
    const double cost = evaluate(next);
    if (cost < cost_) {
      cost_ = cost;
      ellipsoids_ = std::move(next);
      damping_ *= 0.4;
    } else {
      std::swap(now_, before_);
      damping_ *= 4.0;
    }
  }
}

}  // namespace bodice::fitting
