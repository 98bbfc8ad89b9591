#include "tight_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/engine/parallel.hpp>

#include "foot_batch.hpp"

namespace bodice::fitting {
namespace {

constexpr std::size_t kGrain = 512;
/// Ellipsoids this much farther than the nearest do not become the nearest before the next refresh.
constexpr float kCandidateReach = 0.015f;

std::vector<FootEllipsoid> in_floats(std::span<const geometry::Ellipsoid> ellipsoids) {
  return {ellipsoids.begin(), ellipsoids.end()};
}

}  // namespace

TightProblem::TightProblem(std::span<const DistanceSample> samples, const Vec3& origin, double scale,
                           const TightLoss& loss)
    : loss_(loss) {
  for (const DistanceSample& s : samples) {
    for (int j = 0; j < 3; ++j) point_[j].push_back(static_cast<float>((s.point[j] - origin[j]) * scale));
    target_.push_back(static_cast<float>(s.signed_distance_m * scale));
    one_sided_.push_back(s.one_sided);
  }
  pairs_of_.resize(samples.size());
  owner_.resize(samples.size());
  cost_.resize(samples.size());
  second_cost_.resize(samples.size());
  residual_.resize(samples.size());
}

void TightProblem::refresh(const engine::Context& context, std::span<const geometry::Ellipsoid> ellipsoids) {
  ellipsoids_ = ellipsoids.size();
  const auto es = in_floats(ellipsoids);
  const std::size_t samples = target_.size();
  const int near = std::min<int>(kNear, static_cast<int>(es.size()));
  std::vector<std::array<std::uint32_t, kNear>> candidates(samples);
  std::vector<std::uint8_t> count_of(samples);
  engine::parallel_for(context, samples, kGrain, [&](std::size_t begin, std::size_t end) {
    std::array<std::array<float, kNear>, kGrain> best;
    std::array<float, kGrain> d;
    for (auto& b : best) b.fill(std::numeric_limits<float>::infinity());
    for (std::uint32_t k = 0; k < es.size(); ++k) {
      rough_distances(es[k], end - begin, &point_[0][begin], &point_[1][begin], &point_[2][begin], d.data());
      for (std::size_t i = 0; i < end - begin; ++i) {
        if (!(d[i] < best[i][near - 1])) continue;
        int slot = near - 1;
        for (; slot > 0 && d[i] < best[i][slot - 1]; --slot) {
          best[i][slot] = best[i][slot - 1];
          candidates[begin + i][slot] = candidates[begin + i][slot - 1];
        }
        best[i][slot] = d[i];
        candidates[begin + i][slot] = k;
      }
    }
    for (std::size_t i = 0; i < end - begin; ++i) {
      int count = 1;
      while (count < near && best[i][count] <= best[i][0] + kCandidateReach) ++count;
      count_of[begin + i] = static_cast<std::uint8_t>(count);
    }
  });
  pair_begin_.assign(ellipsoids_ + 1, 0);
  for (std::size_t i = 0; i < samples; ++i)
    for (int s = 0; s < count_of[i]; ++s) ++pair_begin_[candidates[i][s] + 1];
  for (std::size_t k = 0; k < ellipsoids_; ++k) pair_begin_[k + 1] += pair_begin_[k];
  const std::size_t pairs = pair_begin_.back();
  pair_sample_.resize(pairs);
  ellipsoid_of_pair_.resize(pairs);
  distance_.resize(pairs);
  previous_.resize(pairs);
  for (auto& axis : pair_point_) axis.resize(pairs);
  std::vector<std::uint32_t> next(pair_begin_.begin(), pair_begin_.end() - 1);
  for (std::uint32_t i = 0; i < samples; ++i)
    for (int s = 0; s < kNear; ++s) {
      if (s >= count_of[i]) {
        pairs_of_[i][s] = pairs_of_[i][0];
        continue;
      }
      const std::uint32_t k = candidates[i][s], p = next[k]++;
      pair_sample_[p] = i;
      ellipsoid_of_pair_[p] = k;
      for (int j = 0; j < 3; ++j) pair_point_[j][p] = point_[j][i];
      pairs_of_[i][s] = p;
    }
  evaluate(context, ellipsoids);
  assign(context);
}

void TightProblem::evaluate(const engine::Context& context, std::span<const geometry::Ellipsoid> ellipsoids) {
  std::swap(distance_, previous_);
  engine::parallel_for(context, ellipsoids.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t first = pair_begin_[k];
      foot_distances(FootEllipsoid(ellipsoids[k]), pair_begin_[k + 1] - first, pair_point_[0].data() + first,
                     pair_point_[1].data() + first, pair_point_[2].data() + first, distance_.data() + first);
    }
  });
}

void TightProblem::restore(std::size_t k) {
  std::copy(previous_.begin() + pair_begin_[k], previous_.begin() + pair_begin_[k + 1],
            distance_.begin() + pair_begin_[k]);
}

float TightProblem::cost_at(std::size_t i, float d) const {
  const float target = target_[i];
  if (one_sided_[i] && d >= target) return 0.0f;
  if (target < -loss_.ignore_depth && d < -0.5f * loss_.ignore_depth) return 0.0f;
  if (target > loss_.far && d > loss_.far) return 0.0f;
  const float r = std::fabs(d - target);
  const bool uncovered = target <= 0.0f && d > 0.0f;
  const float h = uncovered ? loss_.uncovered_huber : loss_.huber;
  const float w = uncovered ? loss_.uncovered_weight : 1.0f;
  return w * (r <= h ? 0.5f * r * r : h * (r - 0.5f * h));
}

void TightProblem::assign(const engine::Context& context) {
  engine::parallel_for(context, target_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::uint32_t best = pairs_of_[i][0];
      float second = std::numeric_limits<float>::infinity();
      for (int s = 1; s < kNear; ++s) {
        const std::uint32_t p = pairs_of_[i][s];
        if (p == pairs_of_[i][0]) break;
        if (distance_[p] < distance_[best]) {
          second = distance_[best];
          best = p;
        } else {
          second = std::min(second, distance_[p]);
        }
      }
      owner_[i] = best;
      residual_[i] = distance_[best] - target_[i];
      cost_[i] = cost_at(i, distance_[best]);
      second_cost_[i] = cost_at(i, std::min(second, distance_[best] + kCandidateReach));
    }
  });
}

void TightProblem::remember() {
  remembered_owner_ = owner_;
  remembered_cost_ = cost_;
}

double TightProblem::total() const {
  double sum = 0.0;
  for (const float c : cost_) sum += static_cast<double>(c);
  return sum;
}

std::vector<double> TightProblem::cost_of_each() const {
  std::vector<double> cost(ellipsoids_, 0.0);
  for (std::size_t i = 0; i < owner_.size(); ++i)
    cost[ellipsoid_of_pair_[owner_[i]]] += static_cast<double>(cost_[i]);
  return cost;
}

std::vector<double> TightProblem::use_of_each() const {
  std::vector<double> use(ellipsoids_, 0.0);
  for (std::size_t i = 0; i < owner_.size(); ++i)
    use[ellipsoid_of_pair_[owner_[i]]] += static_cast<double>(second_cost_[i] - cost_[i]);
  return use;
}

std::vector<std::size_t> TightProblem::skin_of_each() const {
  std::vector<std::size_t> held(ellipsoids_, 0);
  for (const std::uint32_t e : skin_owner())
    if (e != kNoOwner) ++held[e];
  return held;
}

std::vector<std::uint32_t> TightProblem::skin_owner() const {
  std::vector<std::uint32_t> owner(owner_.size(), kNoOwner);
  for (std::size_t i = 0; i < owner_.size(); ++i)
    if (!one_sided_[i] && std::fabs(target_[i]) < 0.005f && distance_[owner_[i]] < loss_.far)
      owner[i] = ellipsoid_of_pair_[owner_[i]];
  return owner;
}

std::vector<double> TightProblem::gains() const {
  std::vector<double> gain(ellipsoids_, 0.0);
  for (std::size_t i = 0; i < owner_.size(); ++i) {
    const double fall = static_cast<double>(remembered_cost_[i] - cost_[i]);
    const std::uint32_t before = ellipsoid_of_pair_[remembered_owner_[i]],
                        now = ellipsoid_of_pair_[owner_[i]];
    gain[before] += fall;
    if (now != before) gain[now] += fall;
  }
  return gain;
}

std::vector<NormalBlock> TightProblem::normal_equations(
    const engine::Context& context, std::span<const geometry::Ellipsoid> ellipsoids) const {
  std::vector<NormalBlock> blocks(ellipsoids_);
  engine::parallel_for(context, ellipsoids_, 4, [&](std::size_t begin, std::size_t end) {
    std::array<std::vector<float>, 3> p;
    std::array<std::vector<float>, 4> out;
    std::vector<std::uint32_t> mine;
    for (std::size_t k = begin; k < end; ++k) {
      mine.clear();
      for (auto& axis : p) axis.clear();
      for (std::uint32_t pair = pair_begin_[k]; pair < pair_begin_[k + 1]; ++pair) {
        const std::uint32_t i = pair_sample_[pair];
        if (owner_[i] != pair || cost_[i] == 0.0f) continue;
        mine.push_back(i);
        for (int j = 0; j < 3; ++j) p[j].push_back(pair_point_[j][pair]);
      }
      for (auto& o : out) o.resize(mine.size());
      foot_details(FootEllipsoid(ellipsoids[k]), mine.size(), p[0].data(), p[1].data(), p[2].data(),
                   out[0].data(), out[1].data(), out[2].data(), out[3].data());
      const geometry::Ellipsoid& e = ellipsoids[k];
      const Eigen::Vector3f radii = e.radii.cast<float>();
      const Eigen::Matrix3f axes = e.axes.cast<float>();
      Eigen::Matrix<float, 9, 9> jtj = Eigen::Matrix<float, 9, 9>::Zero();
      Eigen::Matrix<float, 9, 1> jtr = Eigen::Matrix<float, 9, 1>::Zero();
      for (std::size_t m = 0; m < mine.size(); ++m) {
        const Eigen::Vector3f w(out[1][m], out[2][m], out[3][m]);
        const Eigen::Vector3f foot = radii.cwiseProduct(w), n = w.cwiseQuotient(radii).normalized();
        // The foot minimises the distance, so its own motion drops out of the derivative (envelope theorem).
        Eigen::Matrix<float, 9, 1> j;
        j << -(axes * n), -n.cwiseProduct(foot), -foot.cross(n);
        const float r = residual_[mine[m]];
        const bool uncovered = target_[mine[m]] <= 0.0f && r + target_[mine[m]] > 0.0f;
        const float h = uncovered ? loss_.uncovered_huber : loss_.huber;
        const float weight = (uncovered ? loss_.uncovered_weight : 1.0f) * std::min(1.0f, h / std::fabs(r));
        const Eigen::Matrix<float, 9, 1> wj = weight * j;
        jtj.noalias() += wj * j.transpose();
        jtr += r * wj;
      }
      blocks[k].jtj = jtj.cast<double>();
      blocks[k].jtr = jtr.cast<double>();
    }
  });
  return blocks;
}

}  // namespace bodice::fitting
