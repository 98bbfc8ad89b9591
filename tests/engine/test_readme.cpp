// The code block of engine/README.md, which CMakeLists.txt copies into a source file.
#include <doctest/doctest.h>

#include <bodice/engine/result.hpp>

bodice::engine::Result<double> mean_length();

TEST_CASE("the code in engine/README.md compiles, and computes the mean") {
  const auto mean = mean_length();
  REQUIRE(mean.ok());
  CHECK(*mean == 2.0);
}
