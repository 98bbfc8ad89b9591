#include "motion/shape_blend.hpp"

#include <algorithm>

namespace bodice::inline v0_1::tryon {
namespace {

/// The shortest duration of a blend, and the largest speed of its surface, which may make it longer.
constexpr double kLeast_s = 1.0 / 6.0, kFastest_m_s = 0.1;

double farthest_m(std::span<const geometry::Ellipsoid> a, std::span<const geometry::Ellipsoid> b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    most =
        std::max(most, (a[k].center - b[k].center).norm() + (a[k].radii - b[k].radii).cwiseAbs().maxCoeff());
  return most;
}

}  // namespace

ShapeBlend::ShapeBlend(const proxy::BodyProxy& proxy, std::span<const geometry::Vec3> skin)
    : skin_(skin), skin_before_(skin.begin(), skin.end()) {
  for (const proxy::ProxyEllipsoid& e : proxy.ellipsoids()) own_.push_back(e.shape);
  shapes_ = own_;
  offsets_.resize(own_.size());
}

void ShapeBlend::begin(const ShapeBlend& before) {
  if (before.own_.size() != own_.size() || before.skin_.size() != skin_.size()) return;
  for (std::size_t v = 0; v < skin_.size(); ++v) skin_before_[v] = before.skin(v);
  for (std::size_t k = 0; k < own_.size(); ++k) offsets_[k] = binding::offset_of(own_[k], before.shapes_[k]);
  whole_s_ = std::max(kLeast_s, farthest_m(own_, before.shapes_) / kFastest_m_s);
  share_ = 1.0;
  find_shapes();
}

void ShapeBlend::advance(double dt_s) {
  if (!(share_ > 0.0)) return;
  share_ = std::clamp(share_ - dt_s / whole_s_, 0.0, share_);
  find_shapes();
}

void ShapeBlend::find_shapes() {
  for (std::size_t k = 0; k < own_.size(); ++k) {
    shapes_[k] = own_[k];
    geometry::Mat3 material = own_[k].axes * own_[k].radii.asDiagonal();
    binding::displace(offsets_[k], share_, shapes_[k], material);
  }
}

}  // namespace bodice::tryon
