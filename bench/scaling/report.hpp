#pragma once

#include <string>
#include <vector>

#include <bench_support/origin.hpp>

#include "measure.hpp"
#include "scheduling_cost.hpp"
#include "work_span.hpp"

namespace bodice_bench {

using bench::Origin;

/// A row for each sample; every row has the origin.
std::string to_csv(const std::vector<std::vector<Sample>>& stages, const Origin& origin);
/// Work and span of one stage.
struct Limit {
  std::string stage, element;
  std::size_t size = 0;
  WorkSpan work_span;
};
std::string to_markdown(const std::vector<Limit>& limits, const std::vector<std::vector<Sample>>& strong,
                        const std::vector<std::vector<Sample>>& weak, const std::vector<Cost>& costs,
                        const Origin& origin);
/// A plot of speed-up over workers, with a line for each stage and one for the ideal.
std::string to_svg(const std::vector<std::vector<Sample>>& strong, const Origin& origin);

}  // namespace bodice_bench
