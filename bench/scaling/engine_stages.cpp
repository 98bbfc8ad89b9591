#include <cmath>
#include <memory>

#include <bodice/engine/hash.hpp>
#include <bodice/engine/parallel.hpp>
#include "stage.hpp"

namespace bodice_bench {
namespace {

using namespace bodice::engine;

// Some 60 ns of arithmetic without memory traffic: what scales best.
double churn(double x) {
  for (int i = 0; i < 8; ++i) x = std::sqrt(x * 0.999 + 0.001);
  return x;
}

}  // namespace

Stage arithmetic_stage() {
  return {"parallel_for", "elements", 100'000, 1'000'000, [](std::size_t size) -> Work {
            auto values = std::make_shared<std::vector<double>>(size);
            return [values](const Context& context) {
              parallel_for(context, values->size(), 1024, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) (*values)[i] = churn(static_cast<double>(i));
              });
              Hasher hasher;
              hasher.add(values->front());
              hasher.add(values->back());
              return hasher.value();
            };
          }};
}

Stage reduce_stage() {
  return {"ordered_reduce", "elements", 100'000, 1'000'000, [](std::size_t size) -> Work {
            return [size](const Context& context) {
              const double sum = ordered_reduce(
                  context, size, 1024, 0.0,
                  [](std::size_t begin, std::size_t end) {
                    double s = 0.0;
                    for (std::size_t i = begin; i < end; ++i) s += churn(static_cast<double>(i));
                    return s;
                  },
                  std::plus<>());
              Hasher hasher;
              hasher.add(sum);
              return hasher.value();
            };
          }};
}

}  // namespace bodice_bench
