#include "cluster/lloyd.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/spatial_order.hpp"
#include "cluster/nearest_centers.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kChunk = 64;  // points a chunk: the ball of a larger one would rule out few centers
constexpr std::size_t kChunkGrain = 64;     // chunks a task: some 20 us of work
constexpr Index kNowhere = ~Index{0};       // a point without a center
constexpr float kDistanceRounding = 1e-5f;  // relative bound on the rounding of a distance in float

}  // namespace

Lloyd::Lloyd(std::span<const Vec3> points, std::span<const double> weights, const Vec3& origin)
    : origin_(origin),
      order_(spatial_order(points)),
      of_point_(points.size(), kNowhere),
      chunks_(engine::block_count(points.size(), kChunk)) {
  weighted_.reserve(points.size());
  for (auto& axis : local_) axis.reserve(points.size());
  for (const Index i : order_) {
    const Vec3 p = points[i] - origin;
    for (int j = 0; j < 3; ++j) local_[j].push_back(static_cast<float>(p[j]));
    weighted_.push_back((weights.empty() ? 1.0 : weights[i]) * Sum(p.x(), p.y(), p.z(), 1.0));
  }
  for (std::size_t c = 0; c < chunks_.size(); ++c) bound_chunk(c);
}

void Lloyd::bound_chunk(std::size_t chunk) {
  const std::size_t begin = chunk * kChunk, end = std::min(begin + kChunk, of_point_.size());
  Chunk& ball = chunks_[chunk];
  for (int j = 0; j < 3; ++j) {
    const auto [low, high] = std::minmax_element(&local_[j][begin], &local_[j][begin] + (end - begin));
    ball.middle[j] = 0.5f * (*low + *high);
  }
  float most = 0.0f;
  for (std::size_t i = begin; i < end; ++i) {
    float squared = 0.0f;
    for (int j = 0; j < 3; ++j) squared += (local_[j][i] - ball.middle[j]) * (local_[j][i] - ball.middle[j]);
    most = std::max(most, squared);
  }
  ball.radius = std::sqrt(most) * (1.0f + kDistanceRounding);
}

std::vector<Index> Lloyd::of_point() const {
  std::vector<Index> result(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) result[order_[i]] = of_point_[i];
  return result;
}

void Lloyd::mark_moved() {
  const std::size_t known = moved_.size();
  moved_.resize(centers_.size());
  placed_.resize(3 * centers_.size());
  moved_list_.clear();
  for (std::size_t k = 0; k < centers_.size(); ++k) {
    const Eigen::Vector3f c = (centers_[k] - origin_).cast<float>();
    moved_[k] = k >= known || !std::equal(c.data(), c.data() + 3, &placed_[3 * k]);
    std::copy_n(c.data(), 3, &placed_[3 * k]);
    if (moved_[k]) moved_list_.push_back(static_cast<Index>(k));
  }
}

/// Finds the centers that can be nearest to a point of the chunk; false if all its points keep their centers.
bool Lloyd::choose_candidates(const Chunk& chunk, Scratch& scratch) const {
  const auto from_middle = [&](Index k) {
    const float x = placed_[3 * k] - chunk.middle[0], y = placed_[3 * k + 1] - chunk.middle[1],
                z = placed_[3 * k + 2] - chunk.middle[2];
    return std::sqrt(x * x + y * y + z * z);
  };
  const auto is_beyond = [](float distance, float most) {
    return distance * (1.0f - kDistanceRounding) > most * (1.0f + kDistanceRounding);
  };
  const auto stays = [&](const Share& share) { return !moved_[share.center]; };
  const auto comes_near = [&](Index k) { return !is_beyond(from_middle(k), chunk.radius + chunk.farthest); };
  if (!chunk.shares.empty() && std::ranges::all_of(chunk.shares, stays) &&
      std::ranges::none_of(moved_list_, comes_near))
    return false;
  scratch.from_middle.clear();
  for (Index k = 0; k < moved_.size(); ++k) scratch.from_middle.push_back(from_middle(k));
  const float most = *std::ranges::min_element(scratch.from_middle) + 2.0f * chunk.radius;
  scratch.candidates.clear();
  for (Index k = 0; k < moved_.size(); ++k)
    if (!is_beyond(scratch.from_middle[k], most)) scratch.candidates.push_back(k);
  return true;
}

void Lloyd::assign_chunk(std::size_t chunk, Scratch& scratch, std::vector<std::uint8_t>& changed) {
  Chunk& ball = chunks_[chunk];
  if (!choose_candidates(ball, scratch)) return;
  const std::size_t first = chunk * kChunk, n = std::min(kChunk, of_point_.size() - first);
  std::array<float, kChunk> distance;
  std::array<Index, kChunk> nearest;
  nearest_centers({n, &local_[0][first], &local_[1][first], &local_[2][first]}, scratch.candidates,
                  placed_.data(), distance.data(), nearest.data());
  std::uint32_t farthest =
      0;  // the bits of a float: vector code compares them faster, as no distance is negative
  Index differ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    farthest = std::max(farthest, std::bit_cast<std::uint32_t>(distance[i]));
    differ |= nearest[i] ^ of_point_[first + i];
  }
  ball.farthest = std::sqrt(std::bit_cast<float>(farthest)) * (1.0f + kDistanceRounding);
  if (differ == 0) return;
  for (std::size_t i = 0; i < n; ++i) {
    Index& own = of_point_[first + i];
    if (nearest[i] == own) continue;
    changed[nearest[i]] = 1;
    if (own != kNowhere) changed[own] = 1;
    own = nearest[i];
  }
  share_out(chunk);
}

void Lloyd::share_out(std::size_t chunk) {
  const std::size_t first = chunk * kChunk, end = std::min(first + kChunk, of_point_.size());
  std::vector<Share>& shares = chunks_[chunk].shares;
  shares.clear();
  for (std::size_t i = first; i < end; ++i) {
    const auto share = std::ranges::find(shares, of_point_[i], &Share::center);
    if (share == shares.end())
      shares.push_back({of_point_[i], weighted_[i]});
    else
      share->sum += weighted_[i];
  }
}

void Lloyd::assign(const engine::Context& context) {
  changed_of_block_.resize(engine::block_count(chunks_.size(), kChunkGrain));
  engine::parallel_for(context, chunks_.size(), kChunkGrain, [&](std::size_t begin, std::size_t end) {
    auto& changed = changed_of_block_[begin / kChunkGrain];
    changed.assign(centers_.size(), 0);
    Scratch scratch;
    for (std::size_t chunk = begin; chunk < end; ++chunk) assign_chunk(chunk, scratch, changed);
  });
  changed_.assign(centers_.size(), 0);
  for (const auto& block : changed_of_block_)
    for (std::size_t k = 0; k < changed_.size(); ++k) changed_[k] |= block[k];
}

/// Moves each center to the mean of its points, also a center that was moved and kept its points; returns the
/// largest move.
double Lloyd::move_centers() {
  std::vector<Sum> sums(centers_.size(), Sum::Zero());
  for (const Chunk& chunk : chunks_)
    for (const auto& [center, sum] : chunk.shares) sums[center] += sum;
  double farthest = 0.0;
  for (std::size_t k = 0; k < centers_.size(); ++k) {
    if (!(changed_[k] || moved_[k]) || !(sums[k][3] > 0.0)) continue;
    const Vec3 mean = origin_ + sums[k].head<3>() / sums[k][3];
    farthest = std::max(farthest, (mean - centers_[k]).norm());
    centers_[k] = mean;
  }
  return farthest;
}

int Lloyd::run(const engine::Context& context, std::vector<Vec3> centers, const KMeansOptions& options) {
  centers_ = std::move(centers);
  int iterations = 0;
  if (of_point_.empty() || centers_.empty()) return iterations;
  while (iterations < options.max_iterations) {
    mark_moved();
    assign(context);
    ++iterations;
    if (move_centers() <= options.sigma_m) break;
  }
  return iterations;
}

}  // namespace bodice::fitting
