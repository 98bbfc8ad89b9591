#include "local_fit.hpp"

#include "tight_step.hpp"

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;

constexpr int kSteps = 6;
constexpr std::size_t kLeastSamples =
    18;                               // two an unknown: with fewer an ellipsoid stays, it might go anywhere
constexpr double kMostMotion = 0.03;  // a step, of the scaled body

/// Ellipsoids among fixed ones: who owns which sample, at which distance.
class Trial {
 public:
  Trial(const Neighbourhood& samples, const TightLoss& loss, std::size_t ellipsoids)
      : samples_(samples),
        loss_(loss),
        distance_(ellipsoids, std::vector<float>(samples.x.size())),
        owner_(samples.x.size()) {}

  double evaluate(const std::vector<Ellipsoid>& ellipsoids) {
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

  NormalBlock normal_equations(std::size_t e, const Ellipsoid& ellipsoid) {
    mine_.clear();
    for (std::size_t i = 0; i < owner_.size(); ++i) {
      const float target = samples_.target[i], d = distance_[e][i];
      if (owner_[i] == e && loss_.cost(target, samples_.one_sided[i], d) > 0.0f)
        mine_.add(samples_.x[i], samples_.y[i], samples_.z[i], d - target, loss_.weight(target, d));
    }
    return mine_.x.size() < kLeastSamples ? NormalBlock{} : normal_block(ellipsoid, mine_);
  }

 private:
  const Neighbourhood& samples_;
  const TightLoss& loss_;
  std::vector<std::vector<float>> distance_;  ///< #ellipsoids x #samples
  std::vector<std::size_t> owner_;            ///< #samples: #ellipsoids if it is one of the others
  BlockSamples mine_;
};

}  // namespace

double fit_locally(const Neighbourhood& samples, const TightLoss& loss, std::vector<Ellipsoid>& ellipsoids) {
  Trial trial(samples, loss, ellipsoids.size());
  double cost = trial.evaluate(ellipsoids), damping = kFirstDamping;
  for (int step = 0; step < kSteps; ++step) {
    std::vector<Ellipsoid> next;
    for (std::size_t e = 0; e < ellipsoids.size(); ++e)
      next.push_back(
          damped_step(ellipsoids[e], trial.normal_equations(e, ellipsoids[e]), damping, kMostMotion)
              .ellipsoid);
    const double now = trial.evaluate(next);
    if (now < cost) {
      cost = now;
      ellipsoids = std::move(next);
      damping *= 0.4;
    } else {
      trial.evaluate(ellipsoids);
      damping *= 4.0;
    }
  }
  return cost - samples.cost;
}

}  // namespace bodice::fitting
