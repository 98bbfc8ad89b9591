// A rotation times a scale, found in a matrix that drift has made a little less than one.
#pragma once

#include <string_view>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// Departure of L^T L from a multiple of the identity that is mended, no unit: entries of L off by a
/// thousandth, which chains of float matrices do not reach.
inline constexpr double kMendedDrift = 4e-3;
/// Least and largest scale: beyond them floats in a body's frame lose their digits.
inline constexpr double kLeastScale = 1e-6, kMostScale = 1e6;

/// A rotation times a scale.
struct Similarity {
  Mat3 rotation = Mat3::Identity();
  double scale = 1.0;
  /// Why the matrix is no similarity, a predicate such as "mirrors"; empty: it is one.
  std::string_view refusal;
};

/// The similarity nearest to a matrix with entries off by at most a thousandth of its scale. Allocates
/// nothing; takes some 200 ns.
Similarity similarity_of(const Mat3& matrix);

/// The rotation nearest to a matrix in the mean square. The matrix must not be singular.
Mat3 polar_rotation(const Mat3& matrix);

}  // namespace bodice::geometry
