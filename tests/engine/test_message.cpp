#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <locale>
#include <string>

#include <bodice/engine/message.hpp>

using bodice::engine::message;

TEST_CASE("message: numbers have the form that people write") {
  CHECK(message("A gap of ", 5.2319123, " mm") == "A gap of 5.232 mm");
  CHECK(message(1e-6, " m") == "1e-06 m");
  CHECK(message(12345.678) == "12346");
  CHECK(message(999.95) == "1000");
  CHECK(message(-1234.5f) == "-1234");
  CHECK(message(1.0 / 3.0, ' ', 2000.25, ' ', 1.0 / 3.0) == "0.3333 2000 0.3333");
  CHECK(message(1.2345e20) == "1.234e+20");
  CHECK(message(std::numeric_limits<double>::infinity()) == "inf");
  CHECK(message(std::uint64_t{12'345'678'901}, std::string(" of "), -3) == "12345678901 of -3");
  CHECK(message().empty());
}

TEST_CASE("message: the text does not depend on the program's locale") {
  struct Grouped : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Grouped));
  const std::string text = message(1234567, ' ', 0.5);
  std::locale::global(before);
  CHECK(text == "1234567 0.5");
}
