// A handful of half-spaces and the closest point of their intersection: what a contact with several
// ellipsoids comes down to, for positions and (through the origin) for velocities.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include <bodice/geometry/types.hpp>

namespace bodice::collision {

/// { x : normal . x >= offset_m }, the normal of unit length.
struct Halfspace {
  geometry::Vec3 normal;
  double offset_m;

  double gap_m(const geometry::Vec3& x) const { return offset_m - normal.dot(x); }  ///< > 0: x violates it
};

/// Up to four half-spaces: three fix a point of space, one more is being replaced.
class Halfspaces {
 public:
  static constexpr int kCapacity = 4;

  int size() const { return size_; }
  const Halfspace& operator[](int i) const { return items_[i]; }
  bool full() const { return size_ == kCapacity; }
  void add(const Halfspace& h) {
    if (!full()) items_[size_++] = h;
  }
  void replace(int i, const Halfspace& h) { items_[i] = h; }

  /// All planes set back by `by_m`.
  Halfspaces lowered(double by_m) const {
    Halfspaces result = *this;
    for (int i = 0; i < size_; ++i) result.items_[i].offset_m -= by_m;
    return result;
  }
  double largest_gap_m(const geometry::Vec3& x) const {
    double largest = 0.0;
    for (int i = 0; i < size_; ++i) largest = std::max(largest, items_[i].gap_m(x));
    return largest;
  }

  /// The closest point of the intersection to `p`, each plane to `tolerance_m`; nothing if the intersection
  /// is empty or so far off that the planes are as good as parallel.
  std::optional<geometry::Vec3> closest_point(const geometry::Vec3& p, double tolerance_m) const {
    if (largest_gap_m(p) <= tolerance_m) return p;
    // Whatever set of planes gives multipliers >= 0 and a point in all half-spaces gives the nearest.
    for (int i = 0; i < size_; ++i)
      if (const auto x = on_planes<1>({i}, p, tolerance_m)) return x;
    for (int i = 0; i < size_; ++i)
      for (int j = i + 1; j < size_; ++j)
        if (const auto x = on_planes<2>({i, j}, p, tolerance_m)) return x;
    for (int left_out = size_ - 1; size_ >= 3 && left_out >= (size_ == 3 ? 2 : 0); --left_out) {
      std::array<int, 3> three{};
      for (int i = 0, n = 0; i < size_ && n < 3; ++i)
        if (size_ == 3 || i != left_out) three[static_cast<std::size_t>(n++)] = i;
      if (const auto x = on_planes<3>(three, p, tolerance_m)) return x;
    }
    return std::nullopt;
  }

  /// The nearest velocity that goes into none of them: the same in the cone of the planes through the origin.
  geometry::Vec3 closest_velocity(const geometry::Vec3& v) const {
    Halfspaces cone = *this;
    for (int i = 0; i < size_; ++i) cone.items_[i].offset_m = 0.0;
    return cone.closest_point(v, kVelocityRounding * v.norm()).value_or(geometry::Vec3::Zero());
  }

  struct RelaxedPoint {
    geometry::Vec3 x;
    double set_back_m;  ///< by how much the planes had to be set back; zero: all are kept
  };

  /// The place within `longest_m` of p that is in all half-spaces, or misses them by as little as can be:
  /// midway between planes that face each other.
  RelaxedPoint least_violating(const geometry::Vec3& p, double longest_m, double tolerance_m) const {
    const auto within_limit = [&](double back_m) -> std::optional<geometry::Vec3> {
      const auto x = lowered(back_m).closest_point(p, tolerance_m);
      return x && (*x - p).norm() <= longest_m ? x : std::nullopt;
    };
    if (const auto x = within_limit(0.0)) return {*x, 0.0};
    double low = 0.0, high = largest_gap_m(p);  // set back by so much, p itself will do
    RelaxedPoint best{p, high};
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      const auto x = within_limit(middle);
      if (x) best = {*x, middle};
      (x ? high : low) = middle;
    }
    return best;
  }

 private:
  static constexpr int kHalvings = 6;  // a third of kMidway
  /// Share of a speed by which a projection may miss its plane; with none every third one would be lost.
  static constexpr double kVelocityRounding = 1e-12;

  /// The projection to the planes of `chosen`, if every one of them pushes and it lies in all half-spaces.
  template <int N>
  std::optional<geometry::Vec3> on_planes(const std::array<int, N>& chosen, const geometry::Vec3& p,
                                          double tolerance_m) const {
    Eigen::Matrix<double, 3, N> normals;
    Eigen::Matrix<double, N, 1> gaps;
    for (int i = 0; i < N; ++i) {
      normals.col(i) = items_[chosen[static_cast<std::size_t>(i)]].normal;
      gaps[i] = items_[chosen[static_cast<std::size_t>(i)]].gap_m(p);
    }
    const Eigen::Matrix<double, N, N> gram = normals.transpose() * normals;
    if (!(std::abs(gram.determinant()) > kParallel)) return std::nullopt;
    const Eigen::Matrix<double, N, 1> push = gram.inverse() * gaps;
    if (!(push.minCoeff() >= 0.0)) return std::nullopt;
    const geometry::Vec3 x = p + normals * push;
    return largest_gap_m(x) <= tolerance_m ? std::optional(x) : std::nullopt;
  }

  static constexpr double kParallel = 1e-9;  // squared sine of the angle between planes
  Halfspace items_[kCapacity];
  int size_ = 0;
};

}  // namespace bodice::collision
