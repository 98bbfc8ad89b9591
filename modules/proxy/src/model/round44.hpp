#pragma once

#include <cmath>

namespace bodice::inline v0_1::proxy {

/// Rounds to 44 significant bits. A change of unit and back perturbs a double by a few units of its 53rd bit,
/// far less than half a unit of the 44th: rounding again gives the same number. Magnitudes below 1e-150
/// become 0, since no change of unit would keep their bits; -0 becomes 0.
inline double round44(double value) {
  if (!(std::abs(value) >= 1e-150)) return std::isnan(value) ? value : 0.0;
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(mantissa, 44)), exponent - 44);
}

}  // namespace bodice::proxy
