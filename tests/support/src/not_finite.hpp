// The numbers that are not finite, for inputs that must be refused.
#pragma once

#include <limits>

namespace bodice_test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

}  // namespace bodice_test
