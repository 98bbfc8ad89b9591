// Values of keys at a time, and what leads from one value to another.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/rig/clip.hpp>

namespace bodice::inline v0_1::rig {

/// The keys around a time: both the same before the first key and after the last one.
struct KeySpan {
  std::size_t before = 0, after = 0;
  double length_s = 0.0, along = 0.0;  ///< along: 0 at `before`, 1 at `after`
};

inline KeySpan find_span(const std::vector<double>& time_s, double time) {
  const auto next = std::upper_bound(time_s.begin(), time_s.end(), time);
  if (next == time_s.begin()) return {};
  const std::size_t before = static_cast<std::size_t>(next - time_s.begin()) - 1;
  if (next == time_s.end()) return {before, before};
  const double length = *next - time_s[before];
  return {before, before + 1, length, (time - time_s[before]) / length};
}

inline Vec3 between(const Vec3& a, const Vec3& b, double along) {
  return a + along * (b - a);
}
inline Eigen::Quaterniond between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double along) {
  return a.slerp(along, b);
}

/// The Hermite spline's four weights: value and tangent at its begin, value and tangent at its end.
inline Eigen::Vector4d hermite(double s, double length) {
  const double s2 = s * s, s3 = s2 * s;
  return {2 * s3 - 3 * s2 + 1, length * (s3 - 2 * s2 + s), 3 * s2 - 2 * s3, length * (s3 - s2)};
}

inline Vec3 blend(const Eigen::Vector4d& w, const Vec3& a, const Vec3& ta, const Vec3& b, const Vec3& tb) {
  return w[0] * a + w[1] * ta + w[2] * b + w[3] * tb;
}
inline Eigen::Quaterniond blend(const Eigen::Vector4d& w, const Eigen::Quaterniond& a,
                                const Eigen::Quaterniond& ta, const Eigen::Quaterniond& b,
                                const Eigen::Quaterniond& tb) {
  const Eigen::Vector4d sum = w[0] * a.coeffs() + w[1] * ta.coeffs() + w[2] * b.coeffs() + w[3] * tb.coeffs();
  return sum.norm() > 0.0 ? Eigen::Quaterniond(Eigen::Vector4d(sum.normalized())) : a;
}

/// Value of a key itself.
template <class T>
const T& key_value(const Keys<T>& keys, std::size_t k) {
  return keys.value[keys.interpolation == Interpolation::kCubic ? 3 * k + 1 : k];
}

/// Value at a time. Precondition: there is a key.
template <class T>
T value_at(const Keys<T>& keys, double time) {
  const KeySpan span = find_span(keys.time_s, time);
  if (span.before == span.after || keys.interpolation == Interpolation::kStep)
    return key_value(keys, span.before);
  if (keys.interpolation == Interpolation::kLinear)
    return between(key_value(keys, span.before), key_value(keys, span.after), span.along);
  return blend(hermite(span.along, span.length_s), key_value(keys, span.before),
               keys.value[3 * span.before + 2], key_value(keys, span.after), keys.value[3 * span.after]);
}

}  // namespace bodice::rig
