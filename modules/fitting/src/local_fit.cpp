#include "local_fit.hpp"

#include "tight_step.hpp"

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;

constexpr std::size_t kLeastSamples =
    18;                               // two an unknown: with fewer an ellipsoid stays, it might go anywhere
constexpr double kMostMotion = 0.03;  // a step, of the scaled body

}  // namespace

LocalFit::LocalFit(const Neighbourhood& samples, const TightLoss& loss, std::vector<Ellipsoid> ellipsoids)
    : samples_(samples),
      loss_(loss),
      ellipsoids_(std::move(ellipsoids)),
      distance_(ellipsoids_.size(), std::vector<float>(samples.x.size())),
      owner_(samples.x.size()),
      damping_(kFirstDamping) {
  cost_ = evaluate(ellipsoids_);
}

double LocalFit::evaluate(const std::vector<Ellipsoid>& ellipsoids) {
  const std::size_t n = samples_.x.size();
  for (std::size_t e = 0; e < ellipsoids.size(); ++e)
    foot_distances(FootEllipsoid(ellipsoids[e]), n, samples_.x.data(), samples_.y.data(), samples_.z.data(),
                   distance_[e].data());
  double cost = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    float least = samples_.others[i];
    owner_[i] = ellipsoids.size();
    for (std::size_t e = 0; e < ellipsoids.size(); ++e)
      if (distance_[e][i] < least) least = distance_[e][i], owner_[i] = e;
    cost += static_cast<double>(loss_.cost(samples_.target[i], samples_.one_sided[i], least));
  }
  return cost;
}

NormalBlock LocalFit::normal_equations(std::size_t e) {
  mine_.start(owner_.size());
  for (std::size_t i = 0; i < owner_.size(); ++i) {
    const float target = samples_.target[i], d = distance_[e][i];
    if (owner_[i] == e && loss_.cost(target, samples_.one_sided[i], d) > 0.0f)
      mine_.add(samples_.x[i], samples_.y[i], samples_.z[i], d - target, loss_.weight(target, d));
  }
  return mine_.count < kLeastSamples ? NormalBlock{} : normal_block(ellipsoids_[e], mine_);
}

void LocalFit::advance(int steps) {
  for (int step = 0; step < steps; ++step) {
    std::vector<Ellipsoid> next;
    for (std::size_t e = 0; e < ellipsoids_.size(); ++e)
      next.push_back(damped_step(ellipsoids_[e], normal_equations(e), damping_, kMostMotion).ellipsoid);
    const double now = evaluate(next);
    if (now < cost_) {
      cost_ = now;
      ellipsoids_ = std::move(next);
      damping_ *= 0.4;
    } else {
      evaluate(ellipsoids_);
      damping_ *= 4.0;
    }
  }
}

}  // namespace bodice::fitting
