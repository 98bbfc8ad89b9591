// Based on: Inigo Quilez. Smooth minimum (quadratic polynomial). 2013. (the union with a blend radius)
#include "figure/flesh.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::synth {
namespace {

// Lengths in statures.
constexpr double kDerivativeStep = 1e-6;  // far below any feature, far above rounding
constexpr double kSurely = 1e-3;          // no value changes so much within a derivative's step
constexpr double kLongestStep = 0.03;     // keeps a Newton step on its own limb
constexpr double kMidGap = 4e-4;          // between thighs that are pressed together
constexpr double kMidBlend = 0.008;       // blend radius there

double smooth_min(double a, double b, double radius) {
  const double h = std::max(radius - std::abs(a - b), 0.0);
  return std::min(a, b) - (radius > 0.0 ? h * h / (4.0 * radius) : 0.0);
}

double smooth_max(double a, double b, double radius) {
  return -smooth_min(-a, -b, radius);
}

}  // namespace

/// The primitives that a value and those within a derivative's step of it depend on, a few of those that are
/// visible.
class Flesh::Deciding {
 public:
  void add(int primitive) {
    if (count_ < primitives_.size())
      primitives_[count_++] = primitive;
    else
      too_many_ = true;
  }
  void clear() {
    count_ = 0;
    too_many_ = false;
  }
  std::span<const int> or_all(const std::vector<int>& visible) const {
    return too_many_ ? std::span<const int>(visible) : std::span(primitives_.data(), count_);
  }

 private:
  std::array<int, 32> primitives_;
  std::size_t count_ = 0;
  bool too_many_ = false;
};

Flesh::Flesh(const Figure& figure) {
  add_trunk(figure);
  add_head(figure);
  for (int side = 0; side < 2; ++side) {
    add_arm(figure, side);
    add_leg(figure, side);
  }
  link_regions();
  link_right_half();
}

void Flesh::add(Region region, Loft loft, double blend) {
  own_[static_cast<int>(region)].push_back(static_cast<int>(primitives_.size()));
  primitives_.push_back({std::move(loft), blend});
}

void Flesh::link_regions() {
  const auto link = [&](Region region, std::initializer_list<Region> seen) {
    auto& list = visible_[static_cast<int>(region)];
    for (const Region r : seen)
      list.insert(list.end(), own_[static_cast<int>(r)].begin(), own_[static_cast<int>(r)].end());
    std::sort(list.begin(), list.end());
  };
  using enum Region;
  link(kTrunk, {kTrunk, kHead, kArmL, kArmR, kLegL, kLegR});
  link(kCrotch, {kTrunk});
  link(kHead, {kTrunk, kHead});
  for (int side = 0; side < 2; ++side) {
    const Region arm = region_of_side(kArmL, side), leg = region_of_side(kLegL, side);
    link(arm, {kTrunk, arm});
    link(leg, {kTrunk, leg});
    for (int d = 0; d < kDigitsPerHand; ++d) {
      link(arm, {digit_region(side, d)});
      link(digit_region(side, d), {arm, digit_region(side, d)});
    }
  }
}

void Flesh::link_right_half() {
  const auto partner = [&](int i) {
    Vec3 wanted = primitives_[i].loft.bound_center();
    wanted.x() = -wanted.x();
    for (std::size_t k = 0; k < primitives_.size(); ++k)
      if ((primitives_[k].loft.bound_center() - wanted).norm() < 1e-9 &&
          std::abs(primitives_[k].loft.bound_radius() - primitives_[i].loft.bound_radius()) < 1e-9)
        return static_cast<int>(k);
    return i;
  };
  for (int r = 0; r < kRegionCount; ++r)
    for (const int i : visible_[static_cast<int>(mirrored(static_cast<Region>(r)))])
      visible_right_[r].push_back(partner(i));
}

const std::vector<int>& Flesh::visible_at(Region region, const Vec3& p) const {
  return (p.x() < 0.0 ? visible_right_ : visible_)[static_cast<std::size_t>(region)];
}

/// The union of some primitives at p. `deciding` receives those of them that matter there and close by.
double Flesh::united(std::span<const int> primitives, Region region, const Vec3& p,
                     Deciding* deciding) const {
  double total = 1.0;
  for (const int i : primitives) {
    const Primitive& primitive = primitives_[static_cast<std::size_t>(i)];
    const double reach = total + primitive.blend + primitive.loft.bound_radius();
    const double apart2 = (p - primitive.loft.bound_center()).squaredNorm();
    const auto out_of_reach = [&](double r) { return r < 0.0 || apart2 > r * r; };
    if (out_of_reach(reach)) {
      if (deciding && !out_of_reach(reach + kSurely)) deciding->add(i);
      continue;
    }
    const double value = primitive.loft.value(p);
    if (deciding && value < total - primitive.blend - kSurely) deciding->clear();
    if (deciding && value < total + primitive.blend + kSurely) deciding->add(i);
    total = smooth_min(total, value, primitive.blend);
  }
  if (region == Region::kLegL) total = smooth_max(total, kMidGap - p.x(), kMidBlend);
  if (region == Region::kLegR) total = smooth_max(total, kMidGap + p.x(), kMidBlend);
  return total;
}

double Flesh::value(Region region, const Vec3& p) const {
  return united(visible_at(region, p), region, p, nullptr);
}

double Flesh::own_value(Region region, const Vec3& p) const {
  double total = 1.0;
  for (const int i : own_[static_cast<int>(region)])
    total = smooth_min(total, primitives_[i].loft.value(p), primitives_[i].blend);
  return total;
}

Vec3 Flesh::gradient(Region region, const Vec3& p, double value, const Deciding& deciding) const {
  // The differences are one-sided, and along x away from the middle plane, so that left and right round
  // alike. In the plane itself the slope along x is zero by symmetry.
  const std::span<const int> primitives = deciding.or_all(visible_at(region, p));
  Vec3 g = Vec3::Zero();
  for (int c = 0; c < 3; ++c) {
    if (c == 0 && std::abs(p.x()) < kDerivativeStep) continue;
    const double step = c == 0 && p.x() < 0.0 ? -kDerivativeStep : kDerivativeStep;
    Vec3 moved = p;
    moved[c] += step;
    g[c] = (united(primitives, region, moved, nullptr) - value) / step;
  }
  return g;
}

Vec3 Flesh::project(Region region, Vec3 p, int steps, Vec3* normal) const {
  Vec3 g = Vec3::UnitY();
  for (int step = 0; step < steps; ++step) {
    Deciding deciding;
    const double f = united(visible_at(region, p), region, p, &deciding);
    g = gradient(region, p, f, deciding);
    const double square = g.squaredNorm();
    if (square < 1e-4) break;  // on an axis there is no direction to move in
    Vec3 move = -f / square * g;
    const double length = move.norm();
    if (length > kLongestStep) move *= kLongestStep / length;
    p += move;
  }
  if (normal) *normal = g.normalized();
  return p;
}

}  // namespace bodice::synth
