#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>

#include <bodice/engine/random.hpp>
#include <bodice/engine/text.hpp>

using namespace bodice::engine;

TEST_CASE("append_number writes what printf writes in the C locale") {
  Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const double value = random.normal() * std::pow(10.0, random.uniform(-300.0, 300.0));
    for (int digits : {1, 6, 9, 12, 17}) {
      char wanted[64];
      std::snprintf(wanted, sizeof wanted, "%.*g", digits, value);
      std::string text = "x ";
      append_number(text, value, digits);
      REQUIRE(text == "x " + std::string(wanted));
    }
  }
}

TEST_CASE(
    "append_number: zeros, the ends of the range, NaN and infinities are written as printf writes them") {
  using Limits = std::numeric_limits<double>;
  for (double value : {0.0, -0.0, 1e5, 1e9, -123456789.0, Limits::max(), Limits::lowest(), Limits::min(),
                       Limits::denorm_min(), Limits::infinity(), -Limits::infinity()}) {
    char wanted[64];
    std::snprintf(wanted, sizeof wanted, "%.17g", value);
    std::string text;
    append_number(text, value, 17);
    CHECK(text == wanted);
  }
  std::string text;
  append_number(text, Limits::quiet_NaN(), 9);
  CHECK(text == "nan");
}

TEST_CASE("hex64 has all sixteen digits") {
  CHECK(hex64(0) == "0000000000000000");
  CHECK(hex64(0x0123456789abcdefull) == "0123456789abcdef");
  CHECK(hex64(~std::uint64_t{0}) == "ffffffffffffffff");
}
