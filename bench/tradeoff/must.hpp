#pragma once

#include <cstdio>
#include <cstdlib>

#include <bodice/engine/result.hpp>

namespace tradeoff {

/// The value of a result; ends the program with the error's sentence if there is none.
template <class T>
T must(bodice::engine::Result<T> result) {
  if (result) return std::move(result).value();
  std::fprintf(stderr, "tradeoff: %s\n", result.error().sentence().c_str());
  std::exit(1);
}

}  // namespace tradeoff
