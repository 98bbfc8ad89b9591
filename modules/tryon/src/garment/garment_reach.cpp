#include <bodice/tryon/garment_reach.hpp>

#include <algorithm>
#include <numeric>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Box;
using geometry::Index;
using geometry::Vec3;

/// The most vertices of a piece, a few square decimeters of cloth.
constexpr std::size_t kMostVertices = 96;

/// Divides the vertices of `order` into halves along the longest side of their box until pieces are small.
/// Appends the index at which each piece begins.
void divide(std::span<const Vec3> positions, std::span<Index> order, std::size_t begin,
            std::vector<std::size_t>& first) {
  if (order.size() <= kMostVertices) {
    first.push_back(begin);
    return;
  }
  Box box;
  for (const Index v : order) box.extend(positions[v]);
  int axis = 0;
  box.size().maxCoeff(&axis);
  const std::size_t half = order.size() / 2;
  std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(half), [&](Index a, Index b) {
    const double x = positions[a][axis], y = positions[b][axis];
    return x < y || (x == y && a < b);
  });
  divide(positions, order.first(half), begin, first);
  divide(positions, order.subspan(half), begin + half, first);
}

}  // namespace

GarmentReach::GarmentReach(std::span<const Vec3> positions) : order_(positions.size()) {
  std::iota(order_.begin(), order_.end(), Index{0});
  if (!order_.empty()) divide(positions, order_, 0, first_);
  around_.resize(first_.size());
  before_.resize(first_.size());
  grown_.resize(first_.size());
  first_.push_back(order_.size());
}

std::span<const Box> GarmentReach::boxes(std::span<const Vec3> positions) {
  around_.swap(before_);
  for (std::size_t i = 0; i < around_.size(); ++i) {
    Box& box = around_[i] = {};
    for (std::size_t v = first_[i]; v < first_[i + 1]; ++v) box.extend(positions[order_[v]]);
    Vec3 by = Vec3::Constant(kContact_m);
    if (!before_[i].empty())
      by += 2.0 * (box.low - before_[i].low).cwiseAbs().cwiseMax((box.high - before_[i].high).cwiseAbs());
    grown_[i] = {box.low - by, box.high + by};
  }
  return grown_;
}

}  // namespace bodice::tryon
