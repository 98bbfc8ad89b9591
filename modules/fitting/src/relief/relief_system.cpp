// Based on: Magnus R. Hestenes, Eduard Stiefel. Methods of Conjugate Gradients for Solving Linear Systems.
// 1952. Differs: it has a diagonal preconditioner and takes few steps, because a texel is a byte and holds no
// more digits.
#include "relief/relief_system.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

// Weights of the regularization, relative to the mean weight of the samples on a node.
constexpr double kSecondDifference = 0.01;
constexpr double kFirstDifference = 0.001;
constexpr double kSlopeRidge = 0.001;
constexpr double kHeightRidge = 1e-6;
constexpr double kEnough = 1e-8;  // solving stops at this fraction of the first squared residual
constexpr std::size_t kSampleGrain = 8192;

}  // namespace

ReliefSystem::ReliefSystem(const engine::Context& context, const ReliefTerms& terms,
                           std::span<const int> nodes_per_side)
    : context_(context),
      terms_(terms),
      tables_(nodes_per_side.size()),
      stencils_(terms.term.size()),
      of_term_(terms.term.size()),
      of_sample_(terms.target_m.size()) {
  std::map<int, std::shared_ptr<const ReliefGrid>> grids;
  for (std::size_t k = 0; k < tables_.size(); ++k) {
    auto& grid = grids[nodes_per_side[k]];
    if (!grid) grid = std::make_shared<const ReliefGrid>(make_relief_grid(nodes_per_side[k]));
    tables_[k].grid = grid;
    tables_[k].first = unknowns_;
    unknowns_ += 2 * static_cast<std::size_t>(grid->unknowns);
  }
  engine::parallel_for(context, tables_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) prepare(k);
  });
}

void ReliefSystem::prepare(std::size_t k) {
  Table& table = tables_[k];
  const ReliefGrid& grid = *table.grid;
  table.weight.assign(static_cast<std::size_t>(grid.unknowns), 0.0);
  double sum = 0.0;
  for (std::size_t m = terms_.begin[k]; m < terms_.begin[k + 1]; ++m) {
    const ReliefTerm& term = terms_.term[m];
    const proxy::TableStencil at = proxy::table_stencil(term.direction.cast<double>(), grid.n);
    const double share = static_cast<double>(term.share);
    const double weight = static_cast<double>(terms_.weight[term.sample]) * share * share;
    for (int j = 0; j < 4; ++j) {
      stencils_[m].unknown[j] = grid.unknown_of[at.node[j]];
      stencils_[m].weight[j] = static_cast<float>(at.weight[j]);
      const double w = weight * at.weight[j] * at.weight[j];
      table.weight[stencils_[m].unknown[j]] += w;
      sum += w;
    }
  }
  const double mean = std::max(sum / grid.unknowns, 1e-12);
  table.second = kSecondDifference * mean;
  table.slope = kFirstDifference * mean;
  table.ridge = kSlopeRidge * mean;
}

void ReliefSystem::read(const Vector& x) const {
  engine::parallel_for(context_, tables_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const double* const h = x.data() + tables_[k].first;
      const double* const a = h + tables_[k].grid->unknowns;
      for (std::size_t m = terms_.begin[k]; m < terms_.begin[k + 1]; ++m) {
        const Stencil& s = stencils_[m];
        const double factor = static_cast<double>(terms_.term[m].slope_factor);
        double value = 0.0;
        for (int j = 0; j < 4; ++j)
          value += static_cast<double>(s.weight[j]) * (h[s.unknown[j]] + factor * a[s.unknown[j]]);
        of_term_[m] = static_cast<double>(terms_.term[m].share) * value;
      }
    }
  });
  engine::parallel_for(context_, of_sample_.size(), kSampleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = 0.0;
      for (std::size_t p = terms_.of_begin[i]; p < terms_.of_begin[i + 1]; ++p) sum += of_term_[terms_.of[p]];
      of_sample_[i] = sum;
    }
  });
}

ReliefSystem::Vector ReliefSystem::write(std::span<const double> of_sample) const {
  Vector y = Vector::Zero(static_cast<Eigen::Index>(unknowns_));
  engine::parallel_for(context_, tables_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      double* const h = y.data() + tables_[k].first;
      double* const a = h + tables_[k].grid->unknowns;
      for (std::size_t m = terms_.begin[k]; m < terms_.begin[k + 1]; ++m) {
        const ReliefTerm& term = terms_.term[m];
        const double value =
            static_cast<double>(terms_.weight[term.sample] * term.share) * of_sample[term.sample];
        const double slope = value * static_cast<double>(term.slope_factor);
        for (int j = 0; j < 4; ++j) {
          const auto u = stencils_[m].unknown[j];
          h[u] += static_cast<double>(stencils_[m].weight[j]) * value;
          a[u] += static_cast<double>(stencils_[m].weight[j]) * slope;
        }
      }
    }
  });
  return y;
}

void ReliefSystem::smooth(const Vector& x, Vector& y) const {
  engine::parallel_for(context_, tables_.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Table& table = tables_[k];
      const int unknowns = table.grid->unknowns;
      for (int part = 0; part < 2; ++part) {
        const double* const from = x.data() + table.first + part * unknowns;
        double* const to = y.data() + table.first + part * unknowns;
        for (const auto& [before, node, after] : table.grid->second) {
          const double bend = table.second * (from[before] - 2.0 * from[node] + from[after]);
          const double slope = table.slope * (from[after] - from[node]);
          to[before] += bend;
          to[node] -= 2.0 * bend + slope;
          to[after] += bend + slope;
        }
        const double ridge = part == 1 ? table.ridge : kHeightRidge / kSlopeRidge * table.ridge;
        for (int u = 0; u < unknowns; ++u) to[u] += ridge * from[u];
      }
    }
  });
}

ReliefSystem::Vector ReliefSystem::inverse_diagonal() const {
  Vector d = Vector::Zero(static_cast<Eigen::Index>(unknowns_));
  for (std::size_t k = 0; k < tables_.size(); ++k) {
    context_.checkpoint();
    const Table& table = tables_[k];
    double* const h = d.data() + table.first;
    double* const a = h + table.grid->unknowns;
    for (std::size_t m = terms_.begin[k]; m < terms_.begin[k + 1]; ++m) {
      const ReliefTerm& term = terms_.term[m];
      const double weight = static_cast<double>(terms_.weight[term.sample] * term.share * term.share);
      const double slope = weight * static_cast<double>(term.slope_factor * term.slope_factor);
      for (int j = 0; j < 4; ++j) {
        const float w = stencils_[m].weight[j];
        h[stencils_[m].unknown[j]] += weight * static_cast<double>(w * w);
        a[stencils_[m].unknown[j]] += slope * static_cast<double>(w * w);
      }
    }
    const double own = 12.0 * table.second + 4.0 * table.slope + table.ridge;
    for (int u = 0; u < 2 * table.grid->unknowns; ++u) h[u] += own;
  }
  return d.cwiseInverse();
}

ReliefSystem::Vector ReliefSystem::solve(Vector x, int steps, const Vector& free) const {
  const Vector inverse = inverse_diagonal().cwiseProduct(free);
  Vector r = write(terms_.target_m);
  const double stop = kEnough * r.dot(inverse.cwiseProduct(r));
  read(x);
  Vector ax = write(of_sample_);
  smooth(x, ax);
  r -= ax;
  Vector z = inverse.cwiseProduct(r), p = z;
  double rz = r.dot(z);
  for (int step = 0; step < steps && rz > stop && rz > 0.0; ++step) {
    read(p);
    Vector ap = write(of_sample_);
    smooth(p, ap);
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

ReliefSystem::Vector ReliefSystem::limit_slopes(Vector& x, double limit_m) const {
  Vector free = Vector::Ones(x.size());
  for (const Table& table : tables_) {
    const auto unknowns = static_cast<std::size_t>(table.grid->unknowns);
    for (std::size_t u = table.first + unknowns; u < table.first + 2 * unknowns; ++u) {
      const auto i = static_cast<Eigen::Index>(u);
      if (std::abs(x[i]) <= limit_m) continue;
      x[i] = std::clamp(x[i], -limit_m, limit_m);
      free[i] = 0.0;
    }
  }
  return free;
}

std::vector<double> ReliefSystem::errors(const Vector& x) const {
  read(x);
  std::vector<double> error(of_sample_.size());
  for (std::size_t i = 0; i < error.size(); ++i) error[i] = terms_.target_m[i] - of_sample_[i];
  return error;
}

std::vector<double> ReliefSystem::error_of_each(const Vector& x) const {
  const std::vector<double> error_of_sample = errors(x);
  std::vector<double> error(tables_.size(), 0.0);
  for (std::size_t k = 0; k < tables_.size(); ++k)
    for (std::size_t m = terms_.begin[k]; m < terms_.begin[k + 1]; ++m)
      error[k] +=
          static_cast<double>(terms_.term[m].share) * std::abs(error_of_sample[terms_.term[m].sample]);
  return error;
}

std::span<const double> ReliefSystem::h(const Vector& x, std::size_t k) const {
  return {x.data() + tables_[k].first, tables_[k].weight.size()};
}

std::span<const double> ReliefSystem::a(const Vector& x, std::size_t k) const {
  return {x.data() + tables_[k].first + tables_[k].weight.size(), tables_[k].weight.size()};
}

std::span<const double> ReliefSystem::weight(std::size_t k) const {
  return tables_[k].weight;
}

}  // namespace bodice::fitting
