#include "walls/upper_arm.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::anatomy {
namespace {

/// The height of the shoulders' middle and the radius of an upper arm, shares of the body's height.
constexpr double kShoulderHeight = 0.79, kUpperArm = 0.027;

SlicePoint middle_of(const Slices& slices, std::size_t slice) {
  return slices.middle([&](std::size_t i) { return slices.depth(slice, i) > 0.0F; });
}

double dot(double u, double v, const SlicePoint& direction) {
  return u * direction[0] + v * direction[1];
}

/// A straight line of least squares.
struct Line {
  double count = 0.0, x = 0.0, xx = 0.0, y = 0.0, xy = 0.0;
  void add(double at, double value) { ++count, x += at, xx += at * at, y += value, xy += at * value; }
  double slope() const {
    const double spread = count * xx - x * x;
    return spread > 0.0 ? (count * xy - x * y) / spread : 0.0;
  }
};

}  // namespace

double UpperArm::along(std::size_t i, const SlicePoint& from, const SlicePoint& direction) const {
  return dot(slices_->u(i) - from[0], slices_->v(i) - from[1], direction);
}

/// How far a slice reaches outward.
double UpperArm::reach(std::size_t slice) const {
  double most = 0.0;
  for (std::size_t i = 0; i < slices_->plane(); ++i)
    if (slices_->depth(slice, i) > 0.0F) most = std::max(most, along(i, center_, outward_));
  return most;
}

bool UpperArm::holds(std::size_t slice, std::size_t i) const {
  if (along(i, center_, outward_) < 0.0) return false;
  const double by = static_cast<double>(slice) - at_;
  const SlicePoint axis{on_axis_[0] + by * by_[0], on_axis_[1] + by * by_[1]};
  const double inward = std::min(along(i, axis, outward_), 0.0);
  double beside = along(i, axis, across());
  if (slice < elbow_) {
    const double forearm = dot(forearm_[0] - axis[0], forearm_[1] - axis[1], across());
    beside -= std::clamp(beside, std::min(forearm, 0.0), std::max(forearm, 0.0));
  }
  return std::hypot(inward, beside) < radius_;
}

std::optional<UpperArm> UpperArm::hanging(const Slices& slices, std::size_t last, const SlicePoint& end) {
  const std::size_t shoulder = slices.count(kShoulderHeight);
  UpperArm arm(slices, middle_of(slices, shoulder));
  arm.radius_ = kUpperArm * static_cast<double>(slices.count());
  const double du = end[0] - arm.center_[0], dv = end[1] - arm.center_[1], far = std::hypot(du, dv);
  if (!(far > arm.radius_)) return std::nullopt;
  arm.outward_ = {du / far, dv / far};
  const double out = arm.reach(shoulder) - arm.radius_, slices_up = static_cast<double>(shoulder - last);
  arm.on_axis_ = end, arm.at_ = static_cast<double>(last);
  for (const std::size_t k : {0U, 1U})
    arm.by_[k] = (arm.center_[k] + out * arm.outward_[k] - end[k]) / slices_up;
  return arm;
}

/// Takes the direction along which shoulders are widest, on the side where a point lies, as outward.
bool UpperArm::set_side(const SlicePoint& end) {
  double uu = 0.0, uv = 0.0, vv = 0.0;
  const std::size_t shoulder = slices_->count(kShoulderHeight);
  for (std::size_t i = 0; i < slices_->plane(); ++i) {
    if (!(slices_->depth(shoulder, i) > 0.0F)) continue;
    const double u = slices_->u(i) - center_[0], v = slices_->v(i) - center_[1];
    uu += u * u, uv += u * v, vv += v * v;
  }
  const double angle = 0.5 * std::atan2(2.0 * uv, uu - vv);
  outward_ = {std::cos(angle), std::sin(angle)};
  const double side = dot(end[0] - center_[0], end[1] - center_[1], outward_);
  if (side < 0.0) outward_ = {-outward_[0], -outward_[1]};
  return side != 0.0;
}

/// Lays the axis a radius inside of what is outermost in the slices.
void UpperArm::fit_axis(std::size_t low, std::size_t high) {
  Line out, beside;
  for (std::size_t k = low; k <= high; ++k) {
    const double most = reach(k);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < slices_->plane(); ++i)
      if (slices_->depth(k, i) > 0.0F && along(i, center_, outward_) > most - radius_)
        sum += along(i, center_, across()), ++count;
    if (!(count > 0.0)) continue;
    out.add(static_cast<double>(k), most - radius_);
    beside.add(static_cast<double>(k), sum / count);
  }
  const double count = std::max(out.count, 1.0);
  at_ = out.x / count;
  for (const std::size_t k : {0U, 1U}) {
    on_axis_[k] = center_[k] + out.y / count * outward_[k] + beside.y / count * across()[k];
    by_[k] = out.slope() * outward_[k] + beside.slope() * across()[k];
  }
}

std::optional<UpperArm> UpperArm::bent(const Slices& slices, std::size_t low, std::size_t high,
                                       const SlicePoint& end) {
  UpperArm arm(slices, middle_of(slices, slices.count(kShoulderHeight)));
  arm.radius_ = kUpperArm * static_cast<double>(slices.count());
  if (!arm.set_side(end)) return std::nullopt;
  arm.fit_axis(low, high);
  arm.forearm_ = end, arm.elbow_ = low + static_cast<std::size_t>(2.0 * arm.radius_);
  return arm;
}

}  // namespace bodice::anatomy
