#include "relief_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/proxy_distance.hpp>

#include "foot_batch.hpp"
#include "relief_grid.hpp"

namespace bodice::fitting {
namespace {

using Vector = Eigen::VectorXd;

// Relative to the mean weight of the samples on a node.
constexpr double kSecondDifference = 0.03;
constexpr double kFirstDifference = 0.003;
constexpr double kSlopeRidge = 0.003;
constexpr int kSolverSteps = 80;

/// One sample seen from one ellipsoid: h(w) + a(w) ratio should be `value`.
struct Equation {
  TableStencil stencil;
  double ratio = 0.0;  ///< clamp(d) / reach.out
  double value = 0.0;  ///< d - s, metres
  double weight = 0.0;
};

struct Answer {
  std::uint32_t ellipsoid = 0;
  Equation equation;
};

constexpr int kMostAnswers = 4;

struct Answers {
  std::array<Answer, kMostAnswers> of;
  int count = 0;
};

/// Weights near the skin count most; what is missed costs more than what is hit falsely.
double importance(double s, double unit) {
  return (1.0 + 12.0 * std::exp(-std::abs(s) / (0.006 * unit))) * (s <= 0.0 ? 1.5 : 1.0);
}

/// The ellipsoids whose distance is within the blend of the least, by exact distance among near candidates.
Answers answers_of(const DistanceSample& sample, const proxy::BodyProxy::Data& data, const ReliefReach& reach,
                   int nodes_per_side) {
  struct Near {
    geometry::NearestPoint foot;
    std::uint32_t index;
  };
  std::vector<Near> near;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < data.ellipsoids.size(); ++k) {
    const geometry::Ellipsoid& e = data.ellipsoids[k].shape;
    const Vec3 to = sample.point - e.center;
    if (to.norm() - e.radii.maxCoeff() > least + reach.blend) continue;
    // n . (x - c) - support(n) is a lower bound of the distance for any unit n; the radial one is near it.
    const Vec3 y = (e.axes.transpose() * to).cwiseQuotient(e.radii);
    const Vec3 n = y.cwiseQuotient(e.radii);
    if (y.squaredNorm() > 1.0 && (y.squaredNorm() - y.norm()) / n.norm() > least + reach.blend) continue;
    const geometry::NearestPoint foot = geometry::nearest_point(e, sample.point);
    least = std::min(least, foot.signed_distance);
    near.push_back({foot, k});
  }
  Answers answers;
  for (const Near& candidate : near) {
    const double d = candidate.foot.signed_distance;
    const double ramp = 1.0 - (d - least) / reach.blend;
    if (!(ramp > 0.0) || answers.count == kMostAnswers) continue;
    const geometry::Ellipsoid& e = data.ellipsoids[candidate.index].shape;
    const double s = std::clamp(sample.signed_distance_m, -reach.out, reach.out);
    if (d < -reach.in && s < -0.5 * reach.in) continue;  // deep inside: nothing to correct
    Equation q;
    const Vec3 w =
        (e.axes.transpose() * (candidate.foot.point - e.center)).cwiseQuotient(e.radii).normalized();
    q.stencil = table_stencil(w, nodes_per_side);
    q.ratio = std::clamp(d, -reach.in, reach.out) / reach.out;
    q.value = d - s;
    q.weight = importance(s, reach.out / 0.030) * std::max(0.05, ramp * ramp);
    answers.of[answers.count++] = {candidate.index, q};
  }
  return answers;
}

/// The normal equations of one ellipsoid's table, applied without being formed.
class TableSystem {
 public:
  TableSystem(const ReliefGrid& grid, const std::vector<Equation>& equations)
      : grid_(grid), equations_(equations), unknowns_(grid.unknowns) {
    data_diagonal_ = Vector::Zero(2 * unknowns_);
    for (const Equation& q : equations_)
      for (int k = 0; k < 4; ++k) {
        const auto id = grid_.unknown_of[q.stencil.node[k]];
        data_diagonal_[id] += q.weight * q.stencil.weight[k] * q.stencil.weight[k];
      }
    const double mean = std::max(data_diagonal_.sum() / unknowns_, 1e-12);
    second_ = kSecondDifference * mean;
    first_ = kFirstDifference * mean;
    ridge_ = kSlopeRidge * mean;
  }

  bool has_data(int unknown) const { return data_diagonal_[unknown] > 0.0; }

  Vector right_side() const {
    Vector b = Vector::Zero(2 * unknowns_);
    for (const Equation& q : equations_) scatter(q, q.weight * q.value, b);
    return b;
  }

  Vector apply(const Vector& x) const {
    Vector y = Vector::Zero(x.size());
    for (const Equation& q : equations_) {
      double f = 0.0;
      for (int k = 0; k < 4; ++k) {
        const auto id = grid_.unknown_of[q.stencil.node[k]];
        f += q.stencil.weight[k] * (x[id] + q.ratio * x[unknowns_ + id]);
      }
      scatter(q, q.weight * f, y);
    }
    for (int part = 0; part < 2; ++part) {
      const int shift = part * unknowns_;
      for (const auto& [before, node, after] : grid_.second) {
        const double bend = second_ * (x[shift + before] - 2.0 * x[shift + node] + x[shift + after]);
        const double slope = first_ * (x[shift + after] - x[shift + node]);
        y[shift + before] += bend;
        y[shift + node] -= 2.0 * bend + slope;
        y[shift + after] += bend + slope;
      }
    }
    y.tail(unknowns_) += ridge_ * x.tail(unknowns_);
    y.head(unknowns_) += 1e-3 * ridge_ * x.head(unknowns_);
    return y;
  }

  Vector preconditioner() const {
    Vector d = Vector::Zero(2 * unknowns_);
    for (const Equation& q : equations_)
      for (int k = 0; k < 4; ++k) {
        const auto id = grid_.unknown_of[q.stencil.node[k]];
        const double w = q.weight * q.stencil.weight[k] * q.stencil.weight[k];
        d[id] += w;
        d[unknowns_ + id] += w * q.ratio * q.ratio;
      }
    d.array() += 12.0 * second_ + 4.0 * first_ + ridge_;
    return d.cwiseInverse();
  }

 private:
  void scatter(const Equation& q, double value, Vector& out) const {
    for (int k = 0; k < 4; ++k) {
      const auto id = grid_.unknown_of[q.stencil.node[k]];
      out[id] += q.stencil.weight[k] * value;
      out[unknowns_ + id] += q.stencil.weight[k] * value * q.ratio;
    }
  }

  const ReliefGrid& grid_;
  const std::vector<Equation>& equations_;
  int unknowns_;
  Vector data_diagonal_;
  double second_ = 0.0, first_ = 0.0, ridge_ = 0.0;
};

/// Conjugate gradients with a diagonal preconditioner, a bounded number of steps from zero.
Vector solve(const TableSystem& system) {
  const Vector inverse = system.preconditioner();
  Vector r = system.right_side();
  Vector x = Vector::Zero(r.size());
  Vector z = inverse.cwiseProduct(r), p = z;
  double rz = r.dot(z);
  const double stop = 1e-8 * rz;
  for (int step = 0; step < kSolverSteps && rz > stop && rz > 0.0; ++step) {
    const Vector ap = system.apply(p);
    const double length = rz / p.dot(ap);
    if (!std::isfinite(length)) break;
    x += length * p;
    r -= length * ap;
    z = inverse.cwiseProduct(r);
    const double next = r.dot(z);
    p = z + (next / rz) * p;
    rz = next;
  }
  return x;
}

struct Range {
  float offset = 0.0f, scale = 0.0f;
  std::uint8_t byte(double value) const {
    if (!(scale > 0.0f)) return 0;
    const double b = (value - static_cast<double>(offset)) / static_cast<double>(scale) * 255.0;
    return static_cast<std::uint8_t>(std::lround(std::clamp(b, 0.0, 255.0)));
  }
};

/// The range of the values that samples speak for; the others are clamped into it.
Range range_of(const TableSystem& system, const Vector& x, int shift, int unknowns) {
  double low = 0.0, high = 0.0;
  bool any = false;
  for (int u = 0; u < unknowns; ++u) {
    if (!system.has_data(u)) continue;
    low = any ? std::min(low, x[shift + u]) : x[shift + u];
    high = any ? std::max(high, x[shift + u]) : x[shift + u];
    any = true;
  }
  return {static_cast<float>(low), static_cast<float>(high - low)};
}

void fill_table(const ReliefGrid& grid, const std::vector<Equation>& equations, proxy::ReliefTable& table,
                std::span<proxy::ReliefTexel> texels) {
  if (equations.empty()) return;
  const TableSystem system(grid, equations);
  const Vector x = solve(system);
  const Range h = range_of(system, x, 0, grid.unknowns),
              a = range_of(system, x, grid.unknowns, grid.unknowns);
  table.h_offset_m = h.offset;
  table.h_scale_m = h.scale;
  table.a_offset = a.offset;
  table.a_scale = a.scale;
  for (std::size_t node = 0; node < texels.size(); ++node) {
    const auto id = grid.unknown_of[node];
    texels[node] = {h.byte(x[id]), a.byte(x[grid.unknowns + id])};
  }
}

}  // namespace

int relief_nodes_per_side(std::size_t ellipsoids) {
  constexpr std::size_t kBytesEach = 15 * 4 + sizeof(proxy::ReliefTable);
  if (ellipsoids == 0 || ellipsoids * kBytesEach >= kReliefBytes) return 0;
  const double texels = static_cast<double>(kReliefBytes - ellipsoids * kBytesEach) / (2.0 * ellipsoids);
  const int n = static_cast<int>(std::sqrt(texels));
  return n < 4 ? 0 : std::min(n, 48);
}

void fit_relief(const engine::Context& context, std::span<const DistanceSample> samples, int nodes_per_side,
                proxy::BodyProxy::Data& data) {
  const ReliefReach reach = relief_reach(data.stature_m);
  std::vector<Answers> answers(samples.size());
  engine::parallel_for(context, samples.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      answers[i] = answers_of(samples[i], data, reach, nodes_per_side);
  });
  std::vector<std::vector<Equation>> equations(data.ellipsoids.size());
  for (const Answers& of : answers)
    for (int k = 0; k < of.count; ++k) equations[of.of[k].ellipsoid].push_back(of.of[k].equation);
  answers.clear();
  const ReliefGrid grid = make_relief_grid(nodes_per_side);
  const std::size_t texels = grid.unknown_of.size();
  data.relief.assign(data.ellipsoids.size(), {});
  data.texels.assign(texels * data.ellipsoids.size(), {});
  engine::parallel_for(context, data.ellipsoids.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      data.relief[k].nodes_per_side = static_cast<std::uint16_t>(nodes_per_side);
      data.relief[k].first_texel = static_cast<std::uint32_t>(k * texels);
      fill_table(grid, equations[k], data.relief[k], std::span(data.texels).subspan(k * texels, texels));
    }
  });
}

}  // namespace bodice::fitting
