#include "tight/least_squares_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "base/spatial_order.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kTermGrain = 2048;    // samples a task
constexpr std::size_t kEllipsoidGrain = 8;  // ellipsoids a task
constexpr float kSkin = 0.005f;  // a sample this close to the skin counts as skin, in the scaled body

}  // namespace

LeastSquaresProblem::LeastSquaresProblem(std::span<const DistanceSample> samples, const Scaling& scaling,
                                         const RobustLoss& loss, double most_motion, int candidates)
    : scaling_(scaling),
      loss_(loss),
      most_motion_(most_motion),
      candidates_(candidates),
      reach_(2.0f * static_cast<float>(most_motion)) {
  add(samples);
}

void LeastSquaresProblem::add(std::span<const DistanceSample> samples) {
  std::vector<Vec3> points;
  points.reserve(samples.size());
  for (const DistanceSample& s : samples) points.push_back((s.point - scaling_.origin) * scaling_.scale);
  for (const std::uint32_t i : spatial_order(points)) {
    for (int j = 0; j < 3; ++j) point_[j].push_back(static_cast<float>(points[i][j]));
    target_.push_back(static_cast<float>(samples[i].signed_distance_m * scaling_.scale));
    one_sided_.push_back(samples[i].one_sided);
    part_.push_back(samples[i].part);
  }
  pairs_of_.resize(target_.size());
  found_at_.resize(target_.size());
  count_of_.resize(target_.size());
  owner_.resize(target_.size());
  cost_.resize(target_.size());
  bound_blocks();
}

void LeastSquaresProblem::bound_blocks() {
  for (auto& axis : ball_center_) axis.clear();
  from_center_.resize(target_.size());
  for (std::size_t begin = 0; begin < target_.size(); begin += kSampleBlock)
    bound_block(begin, std::min(begin + kSampleBlock, target_.size()));
}

void LeastSquaresProblem::bound_block(std::size_t begin, std::size_t end) {
  std::array<float, 3> center;
  for (int j = 0; j < 3; ++j) {
    const auto [low, high] = std::minmax_element(&point_[j][begin], &point_[j][begin] + (end - begin));
    center[j] = 0.5f * (*low + *high);
    ball_center_[j].push_back(center[j]);
  }
  for (std::size_t i = begin; i < end; ++i) {
    float squared = 0.0f;
    for (int j = 0; j < 3; ++j) squared += (point_[j][i] - center[j]) * (point_[j][i] - center[j]);
    from_center_[i] = std::sqrt(squared);
  }
}

/// #E x #blocks, for the centers of the blocks: signed distances, and the outward unit normals at the closest
/// points.
struct LeastSquaresProblem::BlockDistances {
  std::array<std::unique_ptr<float[]>, 4> of;
};

void LeastSquaresProblem::measure_centers(const engine::Context& context,
                                          std::span<const FloatEllipsoid> ellipsoids,
                                          BlockDistances& centers) const {
  const std::size_t blocks = ball_center_[0].size();
  for (auto& values : centers.of)
    values = std::make_unique_for_overwrite<float[]>(ellipsoids.size() * blocks);
  engine::parallel_for(context, ellipsoids.size(), kEllipsoidGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin, at = begin * blocks; k < end; ++k, at += blocks)
      batch_normals(ellipsoids[k],
                    {blocks, ball_center_[0].data(), ball_center_[1].data(), ball_center_[2].data()},
                    &centers.of[0][at], &centers.of[1][at], &centers.of[2][at], &centers.of[3][at]);
  });
}

/// Finds each sample's candidates and stores them in pairs_of_ as indices of ellipsoids, which number_pairs()
/// replaces.
void LeastSquaresProblem::choose_candidates(const engine::Context& context,
                                            std::span<const FloatEllipsoid> ellipsoids) {
  BlockDistances centers;
  measure_centers(context, ellipsoids, centers);
  const std::size_t blocks = ball_center_[0].size();
  engine::parallel_for(context, blocks, 16, [&](std::size_t begin, std::size_t end) {
    NearestCandidates found;
    for (std::size_t b = begin; b < end; ++b) {
      const std::size_t first = b * kSampleBlock, samples = std::min(kSampleBlock, target_.size() - first);
      found.find(ellipsoids,
                 {.count = samples,
                  .at = {&point_[0][first], &point_[1][first], &point_[2][first]},
                  .from_center = &from_center_[first],
                  .center = {ball_center_[0][b], ball_center_[1][b], ball_center_[2][b]},
                  .from_ball = {&centers.of[0][b],
                                {&centers.of[1][b], &centers.of[2][b], &centers.of[3][b]},
                                blocks}},
                 reach_);
      for (std::size_t i = 0; i < samples; ++i) {
        count_of_[first + i] = static_cast<std::uint8_t>(std::min(found.count(i), candidates_));
        pairs_of_[first + i] = found.of(i);
        found_at_[first + i] = found.distances(i);
      }
    }
  });
}

/// Orders the pairs by ellipsoid, then by sample. Returns #chunks x #E: the first pair of each chunk of
/// samples.
std::vector<std::uint32_t> LeastSquaresProblem::count_pairs(const engine::Context& context) {
  const std::size_t chunks = engine::block_count(target_.size(), kTermGrain);
  std::vector<std::uint32_t> next(chunks * ellipsoids_, 0);
  engine::parallel_for(context, target_.size(), kTermGrain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* const of_chunk = &next[begin / kTermGrain * ellipsoids_];
    for (std::size_t i = begin; i < end; ++i)
      for (int s = 0; s < count_of_[i]; ++s) ++of_chunk[pairs_of_[i][s]];
  });
  pair_begin_.resize(ellipsoids_ + 1);
  std::uint32_t pairs = 0;
  for (std::size_t k = 0; k < ellipsoids_; ++k) {
    pair_begin_[k] = pairs;
    for (std::size_t c = 0; c < chunks; ++c) pairs += std::exchange(next[c * ellipsoids_ + k], pairs);
  }
  pair_begin_[ellipsoids_] = pairs;
  return next;
}

/// Replaces the ellipsoids in pairs_of_ by indices of pairs, and fills in the pairs.
void LeastSquaresProblem::number_pairs(const engine::Context& context, std::vector<std::uint32_t> next) {
  const std::size_t pairs = pair_begin_.back();
  for (auto* list : {&pair_sample_, &ellipsoid_of_pair_}) list->resize(pairs);
  for (auto* list : {&distance_, &previous_}) list->resize(pairs);
  for (auto& axis : pair_point_) axis.resize(pairs);
  engine::parallel_for(context, target_.size(), kTermGrain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* const of_chunk = &next[begin / kTermGrain * ellipsoids_];
    for (std::size_t i = begin; i < end; ++i)
      for (int s = 0; s < count_of_[i]; ++s) {
        const std::uint32_t p = of_chunk[pairs_of_[i][s]]++;
        pair_sample_[p] = static_cast<std::uint32_t>(i);
        distance_[p] = found_at_[i][s];
        pairs_of_[i][s] = p;
      }
  });
  engine::parallel_for(context, ellipsoids_, kEllipsoidGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      for (std::uint32_t p = pair_begin_[k]; p < pair_begin_[k + 1]; ++p) {
        ellipsoid_of_pair_[p] = static_cast<std::uint32_t>(k);
        for (int j = 0; j < 3; ++j) pair_point_[j][p] = point_[j][pair_sample_[p]];
      }
  });
}

void LeastSquaresProblem::refresh(const engine::Context& context,
                                  std::span<const geometry::Ellipsoid> ellipsoids) {
  ellipsoids_ = ellipsoids.size();
  choose_candidates(context, std::vector<FloatEllipsoid>(ellipsoids.begin(), ellipsoids.end()));
  number_pairs(context, count_pairs(context));
  assign(context);
}

void LeastSquaresProblem::evaluate(const engine::Context& context,
                                   std::span<const geometry::Ellipsoid> ellipsoids) {
  std::swap(distance_, previous_);
  engine::parallel_for(context, ellipsoids.size(), kEllipsoidGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t first = pair_begin_[k];
      batch_distances(FloatEllipsoid(ellipsoids[k]),
                      {pair_begin_[k + 1] - first, pair_point_[0].data() + first,
                       pair_point_[1].data() + first, pair_point_[2].data() + first},
                      distance_.data() + first);
    }
  });
}

void LeastSquaresProblem::restore(std::size_t k) {
  std::copy(previous_.begin() + pair_begin_[k], previous_.begin() + pair_begin_[k + 1],
            distance_.begin() + pair_begin_[k]);
}

void LeastSquaresProblem::assign(const engine::Context& context) {
  engine::parallel_for(context, target_.size(), kTermGrain, [&](std::size_t begin, std::size_t end) {
    std::array<float, kTermGrain> nearest;
    for (std::size_t i = begin; i < end; ++i) {
      std::uint32_t best = pairs_of_[i][0];
      float least = distance_[best];
      for (int s = 1; s < count_of_[i]; ++s) {
        const std::uint32_t p = pairs_of_[i][s];
        const float d = distance_[p];
        best = d < least ? p : best;
        least = d < least ? d : least;
      }
      owner_[i] = best;
      nearest[i - begin] = least;
    }
    count_costs(loss_, end - begin, &target_[begin], &one_sided_[begin], nearest.data(), &cost_[begin]);
  });
}

void LeastSquaresProblem::remember() {
  remembered_owner_ = owner_;
  remembered_cost_ = cost_;
}

double LeastSquaresProblem::total() const {
  double sum = 0.0;
  for (const float c : cost_) sum += static_cast<double>(c);
  return sum;
}

std::vector<Nearest3> LeastSquaresProblem::rank(const engine::Context& context) const {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  std::vector<Nearest3> ranked(target_.size());
  engine::parallel_for(context, target_.size(), kTermGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Nearest3 nearest{{~0u, ~0u, ~0u}, {kNone, kNone, kNone}};
      for (int s = 0; s < count_of_[i]; ++s) {
        std::uint32_t k = ellipsoid_of_pair_[pairs_of_[i][s]];
        float d = distance_[pairs_of_[i][s]];
        for (std::size_t slot = 0; slot < nearest.distance.size(); ++slot)
          if (d < nearest.distance[slot]) {
            std::swap(d, nearest.distance[slot]);
            std::swap(k, nearest.ellipsoid[slot]);
          }
      }
      ranked[i] = nearest;
    }
  });
  return ranked;
}

Neighborhood LeastSquaresProblem::around(std::span<const std::uint32_t> ellipsoids,
                                         std::span<const Nearest3> ranked) const {
  const std::uint32_t first = ellipsoids.front(), last = ellipsoids.back();
  Neighborhood found;
  found.resize(pair_begin_[first + 1] - pair_begin_[first] + pair_begin_[last + 1] - pair_begin_[last]);
  std::size_t count = 0;
  const auto add = [&](std::uint32_t i) {
    const Nearest3& nearest = ranked[i];
    std::size_t slot = 0;
    while (slot < 2 && (nearest.ellipsoid[slot] == first || nearest.ellipsoid[slot] == last)) ++slot;
    found.x[count] = point_[0][i], found.y[count] = point_[1][i], found.z[count] = point_[2][i];
    found.target[count] = target_[i];
    found.others[count] = nearest.distance[slot];
    found.one_sided[count] = one_sided_[i];
    found.cost += static_cast<double>(cost_[i]);
    ++count;
  };
  const auto firsts =
      std::span(pair_sample_).subspan(pair_begin_[first], pair_begin_[first + 1] - pair_begin_[first]);
  for (const std::uint32_t i : firsts) add(i);
  auto next = firsts.begin();  // both lists ascend; a sample in both was added with the first
  for (std::uint32_t pair = pair_begin_[last]; last != first && pair < pair_begin_[last + 1]; ++pair) {
    const std::uint32_t i = pair_sample_[pair];
    while (next != firsts.end() && *next < i) ++next;
    if (next == firsts.end() || *next != i) add(i);
  }
  found.resize(count);
  return found;
}

std::vector<std::array<std::uint32_t, body::kAllPartCount>> LeastSquaresProblem::skin_of_each() const {
  std::vector<std::array<std::uint32_t, body::kAllPartCount>> held(ellipsoids_);
  for (std::size_t i = 0; i < owner_.size(); ++i)
    if (!one_sided_[i] && std::fabs(target_[i]) < kSkin && distance_[owner_[i]] < loss_.far)
      ++held[ellipsoid_of_pair_[owner_[i]]][static_cast<std::size_t>(part_[i])];
  return held;
}

std::vector<double> LeastSquaresProblem::gains() const {
  std::vector<double> gain(ellipsoids_, 0.0);
  if (owner_.empty()) return gain;
  std::uint32_t last = 0;  // neighboring samples mostly have the same owner: its sum stays in a register
  double of_last = 0.0;
  for (std::size_t i = 0; i < owner_.size(); ++i) {
    const double fall = static_cast<double>(remembered_cost_[i] - cost_[i]);
    const std::uint32_t before = ellipsoid_of_pair_[remembered_owner_[i]],
                        now = ellipsoid_of_pair_[owner_[i]];
    if (before != last) {
      gain[last] = of_last;
      of_last = gain[last = before];
    }
    of_last += fall;
    if (now != before) gain[now] += fall;
  }
  gain[last] = of_last;
  return gain;
}

/// Gathers the samples that ellipsoid k owns and that have a cost.
void LeastSquaresProblem::gather(std::size_t k, BlockSamples& mine) const {
  const std::uint32_t first = pair_begin_[k], *const sample = pair_sample_.data() + first;
  const auto picked = pick(pair_begin_[k + 1] - first, mine.picked, [&](std::size_t p) {
    const bool owned = owner_[sample[p]] == first + p, costs = cost_[sample[p]] > 0.0f;
    return owned & costs;
  });
  mine.start(picked.size());
  for (const std::uint32_t p : picked) {
    const std::uint32_t pair = first + p;
    mine.add(pair_point_[0][pair], pair_point_[1][pair], pair_point_[2][pair], target_[sample[p]],
             distance_[pair]);
  }
  mine.weigh(loss_);
}

std::vector<NormalBlock> LeastSquaresProblem::normal_equations(
    const engine::Context& context, std::span<const geometry::Ellipsoid> ellipsoids) const {
  std::vector<NormalBlock> blocks(ellipsoids_);
  engine::parallel_for(context, ellipsoids_, kEllipsoidGrain, [&](std::size_t begin, std::size_t end) {
    BlockSamples mine;
    for (std::size_t k = begin; k < end; ++k) {
      gather(k, mine);
      blocks[k] = normal_block(ellipsoids[k], mine);
    }
  });
  return blocks;
}

}  // namespace bodice::fitting
