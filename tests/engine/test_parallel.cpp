#include <doctest/doctest.h>

#include <numeric>

#include <bodice/engine/parallel.hpp>

using namespace bodice::engine;

TEST_CASE("ordered_reduce gives the same bits for any number of workers") {
  auto sum = [](Executor& executor) {
    Context context{.executor = &executor};
    return ordered_reduce(
        context, 100'000, 1000, 0.0,
        [](std::size_t begin, std::size_t end) {
          double s = 0.0;
          for (std::size_t i = begin; i < end; ++i) s += 1.0 / static_cast<double>(i + 1);
          return s;
        },
        std::plus<>());
  };
  const double serial = sum(inline_executor());
  for (int workers : {1, 2, 3, 7}) CHECK(sum(*make_tbb_executor(workers)) == serial);
}
