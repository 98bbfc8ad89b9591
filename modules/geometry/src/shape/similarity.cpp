// Based on: Nicholas J. Higham. Computing the Polar Decomposition - with Applications. 1986.
#include <bodice/geometry/similarity.hpp>

#include <cmath>

#include <Eigen/LU>

namespace bodice::inline v0_1::geometry {

namespace {

constexpr double kScaleRounding = 1e-3;  // of the limits, so that they themselves are within
constexpr int kPolarSteps = 12;
constexpr double kSettled = 1e-14;

Similarity refused(std::string_view refusal) {
  return {Mat3::Identity(), 0.0, refusal};
}

}  // namespace

Similarity similarity_of(const Mat3& matrix) {
  if (!matrix.allFinite()) return refused("is not finite");
  const double volume = matrix.determinant();
  const double size = matrix.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return refused("has no extent");
  if (volume < 0.0) return refused("mirrors");
  Similarity found;
  found.scale = std::cbrt(volume);
  if (!(found.scale >= kLeastScale * (1.0 - kScaleRounding)))
    return refused(size < kLeastScale ? "has nearly no extent" : "is flat");
  if (!(found.scale <= kMostScale * (1.0 + kScaleRounding))) return refused("is larger than a million");
  const Mat3 unit = matrix / found.scale;
  const double drift = (unit.transpose() * unit - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(drift <= kMendedDrift)) return refused("shears, or scales its axes unlike");
  found.rotation = polar_rotation(unit);
  return found;
}

Mat3 polar_rotation(const Mat3& matrix) {
  Mat3 r = matrix;
  for (int step = 0; step < kPolarSteps; ++step) {
    const Mat3 next = 0.5 * (r + r.inverse().transpose());
    const double change = (next - r).cwiseAbs().maxCoeff();
    r = next;
    if (change <= kSettled) break;
  }
  return r;
}

}  // namespace bodice::geometry
