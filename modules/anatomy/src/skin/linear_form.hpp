#pragma once

#include <array>
#include <cstddef>

namespace bodice::anatomy {

/// A constant, then what each of N measures counts.
template <std::size_t N>
struct LinearForm {
  std::array<double, N + 1> weight;

  double operator()(const std::array<double, N>& measures) const {
    double sum = weight[0];
    for (std::size_t i = 0; i < N; ++i) sum += weight[i + 1] * measures[i];
    return sum;
  }
};

}  // namespace bodice::anatomy
