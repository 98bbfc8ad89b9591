#include "particle_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "kernels.hpp"
#include "tolerances.hpp"

namespace bodice::collision {

namespace {

constexpr int kBitsPerAxis = 10;
constexpr int kDigitBits = 10;
constexpr std::uint32_t kCells = 1u << kBitsPerAxis;

/// Spreads the low ten bits so that two zeros follow each.
std::uint32_t spread_bits(std::uint32_t v) {
  v = (v | (v << 16)) & 0x030000FFu;
  v = (v | (v << 8)) & 0x0300F00Fu;
  v = (v | (v << 4)) & 0x030C30C3u;
  return (v | (v << 2)) & 0x09249249u;
}

struct Range {
  float low = 0.0f, scale = 0.0f;

  Range(const float* values, std::size_t count) {
    float least = std::numeric_limits<float>::max(), largest = -least;
    for (std::size_t i = 0; i < count; ++i) {
      // Values that are not finite, or absurd, do not stretch the grid.
      const float v = std::abs(values[i]) < kFarthest ? values[i] : least;
      least = std::min(least, v);
      largest = std::max(largest, std::abs(values[i]) < kFarthest ? v : largest);
    }
    low = least;
    if (largest > least) scale = static_cast<float>(kCells - 1) / (largest - least);
  }

  std::uint32_t cell(float v) const {
    const float at = (v - low) * scale;
    // Also false for NaN.
    return at > 0.0f ? static_cast<std::uint32_t>(std::min(at, static_cast<float>(kCells - 1))) : 0u;
  }
};

}  // namespace

void ParticleOrder::refresh(const Particles& particles) {
  const bool changed = order_.size() != particles.count;
  const double spread = std::accumulate(radius_m_.begin(), radius_m_.end(), 0.0);
  if (!changed && spread_when_sorted_m_ < 0.0) spread_when_sorted_m_ = spread;
  if (!changed && spread <= kSortAgain * spread_when_sorted_m_) return;
  sort(particles);
}

void ParticleOrder::sort(const Particles& particles) {
  const std::size_t count = particles.count;
  order_.resize(count);
  other_order_.resize(count);
  key_.resize(count);
  other_key_.resize(count);
  radius_m_.assign((count + kBlock - 1) / kBlock, 0.0f);
  spread_when_sorted_m_ = -1.0;
  const Range x(particles.x, count), y(particles.y, count), z(particles.z, count);
  for (std::size_t i = 0; i < count; ++i) {
    order_[i] = static_cast<std::uint32_t>(i);
    key_[i] = spread_bits(x.cell(particles.x[i])) | spread_bits(y.cell(particles.y[i])) << 1 |
              spread_bits(z.cell(particles.z[i])) << 2;
  }
  // Radix sort, least digit first: stable, so that equal keys keep the caller's order.
  for (int shift = 0; shift < 3 * kBitsPerAxis; shift += kDigitBits) {
    std::array<std::uint32_t, 1u << kDigitBits> start{};
    constexpr std::uint32_t kMask = (1u << kDigitBits) - 1;
    for (const std::uint32_t key : key_) ++start[key >> shift & kMask];
    std::exclusive_scan(start.begin(), start.end(), start.begin(), 0u);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t to = start[key_[i] >> shift & kMask]++;
      other_key_[to] = key_[i];
      other_order_[to] = order_[i];
    }
    key_.swap(other_key_);
    order_.swap(other_order_);
  }
}

Workspace::Workspace() : order_(std::make_unique<ParticleOrder>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

}  // namespace bodice::collision
