#include "model/particle_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <bodice/geometry/detail/morton.hpp>

#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

namespace {

constexpr int kDigitBits = 9;
/// Digits of the keys of all particles of a call, and of those of one task: cells of 4 and of 30 mm of a
/// body.
constexpr int kWholeDigits = 3, kTaskDigits = 2;

/// The cells of a grid along one axis.
struct Range {
  float low = 0.0f, last, scale = 0.0f;

  /// The range of the values [begin, begin + count).
  template <class Values>
  Range(const Values& values, std::size_t begin, std::size_t count, int bits)
      : last(static_cast<float>((1 << bits) - 1)) {
    float least = std::numeric_limits<float>::max(), largest = -least;
    for (std::size_t i = begin; i < begin + count; ++i) {
      // Values that are not finite, or absurdly large, do not stretch the grid.
      const float v = std::abs(values[i]) < kFarthest_m ? values[i] : least;
      least = std::min(least, v);
      largest = std::max(largest, std::abs(values[i]) < kFarthest_m ? v : largest);
    }
    low = least;
    if (largest > least) scale = last / (largest - least);
  }

  std::uint32_t cell(float v) const {
    const float at = (v - low) * scale;
    // The comparison is false for NaN, too.
    return at > 0.0f ? static_cast<std::uint32_t>(std::min(at, last)) : 0u;
  }
};

/// Buffers of a radix sort: indices and keys, each twice.
struct Order {
  std::span<std::uint32_t> order, key, other_order, other_key;
};

/// Sorts the particles [begin, begin + size) along a Z-order curve of 2^(3 bits) cells, in `digits` passes of
/// kDigitBits. The radix sort starts at the least digit and is stable, so that equal keys keep the caller's
/// order.
void sort(const ParticleView& particles, std::size_t begin, int digits, Order o) {
  const std::size_t count = o.order.size();
  const int bits = digits * kDigitBits / 3;
  with_axes(particles, [&](const auto& px, const auto& py, const auto& pz) {
    const Range x(px, begin, count, bits), y(py, begin, count, bits), z(pz, begin, count, bits);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t p = begin + i;
      o.order[i] = static_cast<std::uint32_t>(p);
      o.key[i] = geometry::morton_code(x.cell(px[p]), y.cell(py[p]), z.cell(pz[p]));
    }
  });
  for (int digit = 0; digit < digits; ++digit) {
    std::array<std::uint32_t, 1u << kDigitBits> start{};
    const auto digit_of = [&](std::uint32_t key) {
      return key >> digit * kDigitBits & ((1u << kDigitBits) - 1);
    };
    for (const std::uint32_t key : o.key) ++start[digit_of(key)];
    std::exclusive_scan(start.begin(), start.end(), start.begin(), 0u);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t to = start[digit_of(o.key[i])]++;
      o.other_key[to] = o.key[i];
      o.other_order[to] = o.order[i];
    }
    std::swap(o.key, o.other_key);
    std::swap(o.order, o.other_order);
  }
  if (digits % 2 != 0) std::copy(o.order.begin(), o.order.end(), o.other_order.begin());
}

/// Whether particles half a block apart in the arrays are about as far from each other as any two.
bool scattered(const ParticleView& particles, std::size_t begin, std::size_t end) {
  if (end - begin < 4 * kBlock) return false;
  const std::size_t far = (end - begin) / 2;
  return with_axes(particles, [&](const auto& x, const auto& y, const auto& z) {
    double near_sum = 0.0, far_sum = 0.0;
    const auto distance = [&](std::size_t i, std::size_t j) {
      return std::abs(x[i] - x[j]) + std::abs(y[i] - y[j]) + std::abs(z[i] - z[j]);
    };
    for (std::size_t i = begin; i < begin + far; i += kBlock / 4) {
      const float to_near = distance(i, i + kBlock / 2), to_far = distance(i, i + far);
      if (!(to_near < kFarthest_m && to_far < kFarthest_m)) continue;  // true for NaN, too
      near_sum += double{to_near};
      far_sum += double{to_far};
    }
    return near_sum > kScattered * far_sum;
  });
}

/// Sum over the blocks of the sides of their boxes, meters. An empty `order` means the order of the arrays.
double spread_of(const ParticleView& particles, std::span<const std::uint32_t> order) {
  double sum = 0.0;
  const auto add_sides = [&](const auto& values) {
    for (std::size_t begin = 0; begin < particles.count; begin += kBlock) {
      const std::size_t end = std::min(begin + kBlock, particles.count);
      float low = kFarthest_m, high = -kFarthest_m;
      for (std::size_t i = begin; i < end; ++i) {
        const float v = values[order.empty() ? i : order[i]];
        if (!(std::abs(v) < kFarthest_m)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
      }
      sum += double{std::max(0.0f, high - low)};
    }
  };
  with_axes(particles, [&](const auto&... axes) { (add_sides(axes), ...); });
  return sum;
}

}  // namespace

void ParticleOrder::refresh(const ParticleView& particles) {
  const std::size_t count = particles.count;
  const bool changed = order_.size() != count;
  const double spread = std::accumulate(radius_m_.begin(), radius_m_.end(), 0.0);
  if (!changed && spread_when_sorted_m_ < 0.0) spread_when_sorted_m_ = spread;
  if (!changed && spread <= kSortAgain * spread_when_sorted_m_) return;
  radius_m_.assign((count + kBlock - 1) / kBlock, 0.0f);
  // The order is last, because its size states what was sorted: where memory runs out, the next call sorts.
  for (engine::HostedArray<std::uint32_t>* values : {&other_order_, &key_, &other_key_, &order_})
    values->resize(count);
  spread_when_sorted_m_ = -1.0;
  sort(particles, 0, kWholeDigits, {order_, key_, other_order_, other_key_});
  const double as_sorted = spread_of(particles, order_);
  stored_ = spread_of(particles, {}) <= kStoredWell * as_sorted;
}

std::vector<std::uint32_t> order_if_scattered(const ParticleView& particles) {
  const std::size_t count = particles.count;
  if (!scattered(particles, 0, count)) return {};
  std::vector<std::uint32_t> order(count), key(count), other_order(count), other_key(count);
  sort(particles, 0, kWholeDigits, {order, key, other_order, other_key});
  return order;
}

TaskOrder::TaskOrder(const ParticleView& particles, std::size_t begin, std::size_t end) {
  if (!scattered(particles, begin, end)) return;
  count_ = end - begin;
  const auto some = [this](std::uint32_t* values) { return std::span(values, count_); };
  sort(particles, begin, kTaskDigits, {some(order_), some(key_), some(other_order_), some(other_key_)});
}

}  // namespace bodice::collision
