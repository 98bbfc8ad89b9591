// The intersection of up to four half-spaces, and its closest point. A contact with several ellipsoids comes
// down to this, for positions and, with planes through the origin, for velocities.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::collision {

/// The half-space { x : normal . x >= offset_m }; the normal has unit length.
struct Halfspace {
  geometry::Vec3 normal;
  double offset_m;

  double gap_m(const geometry::Vec3& x) const { return offset_m - normal.dot(x); }  ///< > 0: violated
};

/// A list of up to four half-spaces: three determine a point, and a fourth is there while one is being
/// replaced.
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

  /// The same planes, each set back by `by_m`.
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

  /// The closest point to `p` in all half-spaces, each kept to `tolerance_m`. Nothing if the intersection is
  /// empty, or so far off that the planes are almost parallel.
  std::optional<geometry::Vec3> closest_point(const geometry::Vec3& p, double tolerance_m) const {
    if (largest_gap_m(p) <= tolerance_m) return p;
    // Optimality conditions: the projection onto a subset of the planes is the closest point if its
    // multipliers are >= 0 and it lies in all half-spaces.
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

  /// The closest velocity that leads into none of the planes: the same problem with all planes through the
  /// origin.
  geometry::Vec3 closest_velocity(const geometry::Vec3& v) const {
    Halfspaces cone = *this;
    for (int i = 0; i < size_; ++i) cone.items_[i].offset_m = 0.0;
    return cone.closest_point(v, kVelocityRounding * v.norm()).value_or(geometry::Vec3::Zero());
  }

  /// A point in half-spaces that were set back until they have one.
  struct RelaxedPoint {
    geometry::Vec3 x;
    double set_back_m;  ///< by how much the planes were set back; zero: all are kept
  };

  /// The point within `longest_m` of p that lies in all half-spaces or violates them least: midway between
  /// planes that face each other.
  RelaxedPoint least_violating(const geometry::Vec3& p, double longest_m, double tolerance_m) const {
    const auto within_limit = [&](double back_m) -> std::optional<geometry::Vec3> {
      const auto x = lowered(back_m).closest_point(p, tolerance_m);
      return x && (*x - p).norm() <= longest_m ? x : std::nullopt;
    };
    if (const auto x = within_limit(0.0)) return {*x, 0.0};
    double low = 0.0, high = largest_gap_m(p);  // set back by `high`, the planes admit p itself
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
  static constexpr int kHalvings = 6;  // gives a third of kMidway
  /// Fraction of the speed by which a projected velocity may miss its plane; without it every third
  /// projection would be rejected.
  static constexpr double kVelocityRounding = 1e-12;

  /// Projects p onto the planes of `chosen`; nothing unless each of them pushes and the result lies in all
  /// half-spaces.
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
