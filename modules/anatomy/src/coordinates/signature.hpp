// Landmarks on the skin by their signature: features of a vertex that hardly differ among bodies.
#pragma once

#include "coordinates/border.hpp"

namespace bodice::inline v0_1::anatomy {

/// A landmark is the vertex of least Mahalanobis distance between its N features and their expectation, which
/// follows Z measures of the whole body.
template <int N, int Z>
struct Signature {
  std::array<float, N> mean;
  std::array<float, N * Z> of_body;         ///< row-major: how the features follow the measures of the body
  std::array<float, N*(N + 1) / 2> whiten;  ///< upper triangle by rows

  std::array<float, N> expected(const std::array<float, Z>& body) const {
    std::array<float, N> x = mean;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < Z; ++j) x[i] += of_body[i * Z + j] * body[j];
    return x;
  }

  float distance2(const std::array<float, N>& x, const std::array<float, N>& expected) const {
    float sum = 0.0F;
    for (int i = 0, k = 0; i < N; ++i) {
      float y = 0.0F;
      for (int j = i; j < N; ++j) y += whiten[k++] * (x[j] - expected[j]);
      sum += y * y;
    }
    return sum;
  }
};

/// Makes a signature from the coefficients of its file.
template <int N, int Z>
constexpr Signature<N, Z> make_signature(const double (&mean)[N], const double (&of_body)[N * Z],
                                         const double (&whiten)[N * (N + 1) / 2]) {
  return {to_floats(mean), to_floats(of_body), to_floats(whiten)};
}

}  // namespace bodice::anatomy
