#include "garment/thickness.hpp"

#include <algorithm>
#include <cstdint>

#include <bodice/engine/parallel.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

constexpr double kHalfCloth_m = 0.5e-3;
constexpr double kLeastThickness_m = 1e-3;  // rounding, and the linear distances of cloth's contact
constexpr double kMostThickness_m = 8e-3;   // a wider gap is visible
constexpr double kErrorQuantile = 0.99;
constexpr double kNearSkin_m = 0.05;  // vertices farther away do not come to rest on the skin below them
constexpr std::size_t kGrain = 256;   // vertices a block: about a millisecond of closest points

}  // namespace

std::vector<Vec3> skin_below(const engine::Context& context, const geometry::TriMesh& garment,
                             const geometry::MeshDistance& skin) {
  const std::vector<Vec3>& at = garment.positions;
  std::vector<Vec3> below(at.size());
  std::vector<std::uint8_t> near(at.size(), 0);
  engine::parallel_for(context, at.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!at[i].allFinite()) continue;
      below[i] = skin.closest_point(at[i]).point;
      near[i] = (below[i] - at[i]).norm() <= kNearSkin_m;
    }
  });
  std::size_t count = 0;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (near[i]) below[count++] = below[i];
  below.resize(count);
  return below;
}

void find_uncovered(const engine::Context& context, const collision::Collider& collider,
                    std::span<const Vec3> skin, std::span<float> uncovered_m) {
  engine::parallel_for(context, skin.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f local = (skin[i] - collider.origin()).cast<float>();
      uncovered_m[i] = std::max(0.0f, collider.query({local.x(), local.y(), local.z()}).signed_distance);
    }
  });
}

double thickness_for(std::vector<float> uncovered_m) {
  if (uncovered_m.empty()) return kLeastThickness_m;
  const auto rank = static_cast<std::ptrdiff_t>(kErrorQuantile * static_cast<double>(uncovered_m.size() - 1));
  std::nth_element(uncovered_m.begin(), uncovered_m.begin() + rank, uncovered_m.end());
  return std::clamp(kHalfCloth_m + double{uncovered_m[static_cast<std::size_t>(rank)]}, kLeastThickness_m,
                    kMostThickness_m);
}

double known_thickness_m(const engine::Context& context, const geometry::TriMesh& garment,
                         const geometry::MeshDistance& skin, const collision::Collider& collider) {
  const std::vector<Vec3> below = skin_below(context, garment, skin);
  std::vector<float> uncovered_m(garment.positions.size(), 0.0f);
  find_uncovered(context, collider, below, std::span(uncovered_m).first(below.size()));
  return thickness_for(std::move(uncovered_m));
}

}  // namespace bodice::tryon
