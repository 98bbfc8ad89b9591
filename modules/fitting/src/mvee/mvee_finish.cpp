#include "mvee/mvee_finish.hpp"

#include <Eigen/Geometry>

namespace bodice::inline v0_1::fitting {
namespace {

double largest_level(const PointFrame& frame, const geometry::Ellipsoid& e) {
  const Mat3 whiten = e.radii.cwiseInverse().asDiagonal() * e.axes.transpose();
  double largest = 0.0;
  for (const Vec3& p : frame.kept) largest = std::max(largest, (whiten * (p - e.center)).squaredNorm());
  return largest;
}

/// Rotates the columns of `half` against each other until they are orthogonal, and sorts them from the
/// longest down. One-sided Jacobi rotations keep the relative accuracy of small columns.
void orthogonalize(Mat3& half) {
  constexpr int kSweeps = 30;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool rotated = false;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        const double a = half.col(p).squaredNorm(), b = half.col(q).squaredNorm();
        const double c = half.col(p).dot(half.col(q));
        if (c == 0.0 || std::abs(c) <= 1e-15 * std::sqrt(a) * std::sqrt(b)) continue;
        const double tau = (b - a) / (2.0 * c);
        const double t = (tau < 0.0 ? -1.0 : 1.0) / (std::abs(tau) + std::hypot(1.0, tau));
        const double cosine = 1.0 / std::hypot(1.0, t), sine = cosine * t;
        const Vec3 left = half.col(p);
        half.col(p) = cosine * left - sine * half.col(q);
        half.col(q) = sine * left + cosine * half.col(q);
        rotated = true;
      }
    if (!rotated) break;
  }
  for (int pass = 0; pass < 2; ++pass)
    for (int j = 0; j < 2; ++j)
      if (half.col(j).squaredNorm() < half.col(j + 1).squaredNorm()) half.col(j).swap(half.col(j + 1));
}

/// A right-handed orthonormal basis along the columns of `half`; vanishing columns are replaced.
Mat3 basis_of(const Mat3& half) {
  Mat3 axes = Mat3::Identity();
  const double first = half.col(0).stableNorm();
  if (first == 0.0) return axes;
  axes.col(0) = half.col(0) / first;
  Vec3 second = half.col(1).stableNorm() > 0.0 ? Vec3(half.col(1).stableNormalized()) : Vec3(Vec3::Zero());
  if (second.squaredNorm() == 0.0) {
    int smallest = 0;
    half.col(0).cwiseAbs().minCoeff(&smallest);
    second = Vec3::Unit(smallest);
  }
  const Vec3 lead = axes.col(0);
  axes.col(1) = (second - second.dot(lead) * lead).normalized();
  axes.col(2) = lead.cross(Vec3(axes.col(1)));
  return axes;
}

/// A radius that is positive and harmless whatever the scale of the coordinates.
double radius_floor(const PointFrame& frame, double longest, double min_radius_m) {
  const double noise = 16.0 * std::numeric_limits<double>::epsilon() * frame.origin.cwiseAbs().maxCoeff();
  // Rounding across a flat set's plane must change the level of its points by at most 1e-6.
  return std::max({min_radius_m, kFlatRelative * longest, 1e3 * frame.thickness, noise,
                   std::numeric_limits<double>::min() * 1e20});
}

}  // namespace

geometry::Ellipsoid spanned(const Vec3& center, const Mat3& half) {
  Mat3 columns = half;
  orthogonalize(columns);
  geometry::Ellipsoid e;
  e.center = center;
  e.axes = basis_of(columns);
  for (int j = 0; j < 3; ++j) e.radii[j] = columns.col(j).stableNorm();
  return e;
}

void certify(const PointFrame& frame, const Vec3& center, const Mat3& half, double dual_log_volume,
             double min_radius_m, Mvee& result) {
  geometry::Ellipsoid& e = result.ellipsoid;
  e = spanned(center, half);
  const double floor = radius_floor(frame, e.radii[0], min_radius_m);
  e.radii = e.radii.cwiseMax(floor);

  result.rank = frame.rank;
  // Growing repeats, because rounding of the level depends on the radii of very thin ellipsoids.
  constexpr int kGrowPasses = 4;
  double reach = std::sqrt(largest_level(frame, e));
  for (int pass = 0; pass < kGrowPasses && reach > 1.0; ++pass) {
    e.radii *= reach * (1.0 + 1e-14);
    reach = std::sqrt(largest_level(frame, e));
  }
  double log_volume = 0.0;
  for (int j = 0; j < frame.rank; ++j) log_volume += std::log(e.radii[j]);
  result.volume_gap = frame.rank > 0 ? std::max(0.0, log_volume - dual_log_volume) : 0.0;
  result.violation = std::max(0.0, reach - 1.0);
}

Mvee finish_thin(const PointFrame& frame, double min_radius_m) {
  Mvee result;
  Mat3 half = Mat3::Zero();
  if (frame.rank == 1) half.col(0) = frame.extent[0] * frame.axes.col(0);
  result.rounds = 1;
  certify(frame, frame.origin, half, frame.rank == 1 ? std::log(frame.extent[0]) : 0.0, min_radius_m, result);
  return result;
}

}  // namespace bodice::fitting
