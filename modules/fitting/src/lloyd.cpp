#include "lloyd.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include <bodice/engine/parallel.hpp>

#include "nearest_centers.hpp"

namespace bodice::fitting {
namespace {

constexpr std::size_t kGrain = 4096;  // points a block: some 20 us of work
constexpr std::size_t kChunk = 512;   // points whose scratch stays in the nearest cache
constexpr Index kNowhere = ~Index{0};

}  // namespace

Lloyd::Lloyd(std::span<const Vec3> points, std::span<const double> weights, const Vec3& origin)
    : points_(points),
      weights_(weights),
      origin_(origin),
      of_point_(points.size(), kNowhere),
      distance_(points.size(), std::numeric_limits<float>::infinity()) {
  for (int j = 0; j < 3; ++j) {
    local_[j].resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      local_[j][i] = static_cast<float>(points[i][j] - origin[j]);
  }
}

void Lloyd::mark_moved() {
  const std::size_t known = moved_.size();
  moved_.resize(centers_.size());
  placed_.resize(3 * centers_.size());
  sums_.resize(centers_.size(), Eigen::Vector4d::Zero());
  moved_list_.clear();
  for (std::size_t k = 0; k < centers_.size(); ++k) {
    const Eigen::Vector3f c = (centers_[k] - origin_).cast<float>();
    moved_[k] = k >= known || !std::equal(c.data(), c.data() + 3, &placed_[3 * k]);
    std::copy_n(c.data(), 3, &placed_[3 * k]);
    if (moved_[k]) moved_list_.push_back(static_cast<Index>(k));
  }
  all_.resize(centers_.size());
  std::iota(all_.begin(), all_.end(), Index{0});
}

void Lloyd::assign_block(std::size_t begin, std::size_t end, Flags& changed) {
  std::array<float, kChunk> near, x, y, z;
  std::array<Index, kChunk> which, again;
  const auto settle = [&](std::size_t i, float distance, Index to) {
    distance_[i] = distance;
    if (to == of_point_[i]) return;
    changed[to] = 1;
    if (of_point_[i] != kNowhere) changed[of_point_[i]] = 1;
    of_point_[i] = to;
  };
  for (std::size_t first = begin; first < end; first += kChunk) {
    const std::size_t n = std::min(kChunk, end - first);
    nearest_centers(n, &local_[0][first], &local_[1][first], &local_[2][first], moved_list_.size(),
                    moved_list_.data(), placed_.data(), near.data(), which.data());
    std::size_t lost = 0;  // points whose centre went away: any centre may be nearest now
    for (std::size_t i = first; i < first + n; ++i) {
      const Index own = of_point_[i];
      const float d = near[i - first];
      const Index k = which[i - first];
      if (own == kNowhere) {
        settle(i, d, k);
      } else if (!moved_[own]) {
        if (d < distance_[i] || (d == distance_[i] && k < own)) settle(i, d, k);
      } else if (d <= distance_[i]) {
        settle(i, d, k);
      } else {
        x[lost] = local_[0][i], y[lost] = local_[1][i], z[lost] = local_[2][i];
        again[lost++] = static_cast<Index>(i);
      }
    }
    nearest_centers(lost, x.data(), y.data(), z.data(), all_.size(), all_.data(), placed_.data(), near.data(),
                    which.data());
    for (std::size_t m = 0; m < lost; ++m) settle(again[m], near[m], which[m]);
  }
}

void Lloyd::assign(const engine::Context& context) {
  changed_of_block_.resize(engine::block_count(points_.size(), kGrain));
  engine::parallel_for(context, points_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Flags& changed = changed_of_block_[begin / kGrain];
    changed.assign(centers_.size(), 0);
    assign_block(begin, end, changed);
  });
  changed_.assign(centers_.size(), 0);
  for (const Flags& block : changed_of_block_)
    for (std::size_t k = 0; k < changed_.size(); ++k) changed_[k] |= block[k];
}

/// The sums of the clusters that changed, in block order.
void Lloyd::add_up(const engine::Context& context) {
  sums_of_block_.resize(changed_of_block_.size());
  engine::parallel_for(context, points_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Sums& sums = sums_of_block_[begin / kGrain];
    sums.assign(centers_.size(), Eigen::Vector4d::Zero());
    for (std::size_t i = begin; i < end; ++i) {
      if (!changed_[of_point_[i]]) continue;
      const Vec3 p = points_[i] - origin_;
      sums[of_point_[i]] +=
          (weights_.empty() ? 1.0 : weights_[i]) * Eigen::Vector4d(p.x(), p.y(), p.z(), 1.0);
    }
  });
  for (std::size_t k = 0; k < centers_.size(); ++k) {
    if (!changed_[k]) continue;
    sums_[k].setZero();
    for (const Sums& block : sums_of_block_) sums_[k] += block[k];
  }
}

/// Moves each centre to its cluster's mean, also one that was put elsewhere and kept its points; returns the
/// largest move.
double Lloyd::move_centers() {
  double farthest = 0.0;
  for (std::size_t k = 0; k < centers_.size(); ++k) {
    if (!(changed_[k] || moved_[k]) || !(sums_[k][3] > 0.0)) continue;
    const Vec3 mean = origin_ + sums_[k].head<3>() / sums_[k][3];
    farthest = std::max(farthest, (mean - centers_[k]).norm());
    centers_[k] = mean;
  }
  return farthest;
}

int Lloyd::run(const engine::Context& context, std::vector<Vec3> centers, const KMeansOptions& options) {
  centers_ = std::move(centers);
  int iterations = 0;
  if (points_.empty() || centers_.empty()) return iterations;
  while (iterations < options.max_iterations) {
    mark_moved();
    assign(context);
    add_up(context);
    ++iterations;
    if (move_centers() <= options.sigma_m) break;
  }
  return iterations;
}

}  // namespace bodice::fitting
