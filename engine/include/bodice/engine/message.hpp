// A sentence from words and numbers, in the form that people write.
#pragma once

#include <cmath>
#include <concepts>
#include <locale>
#include <sstream>
#include <string>
#include <type_traits>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// Joins all arguments to one text, the same in any locale. Real numbers have four significant digits, or all
/// those before the point: 0.001235, 12.35, 123457, 1.235e+20.
template <class... Parts>
std::string message(const Parts&... parts) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  [[maybe_unused]] const auto put = [&](const auto& part) {
    if constexpr (std::floating_point<std::decay_t<decltype(part)>>) {
      const double size = std::abs(static_cast<double>(part));
      const bool all_digits = size >= 1e3 && size < 1e9;
      out.precision(all_digits ? 0 : 4);
      out << (all_digits ? std::fixed : std::defaultfloat) << part;
    } else {
      out << part;
    }
  };
  (put(parts), ...);
  return out.str();
}

}  // namespace bodice::engine
