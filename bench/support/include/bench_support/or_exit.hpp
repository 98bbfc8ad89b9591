#pragma once

#include <cstdio>
#include <cstdlib>
#include <utility>

#include <bodice/engine/result.hpp>

namespace bench {

/// The value of a result; ends the program with the error's sentence if there is none.
template <class T>
T or_exit(bodice::engine::Result<T> result) {
  if (result) return std::move(result).value();
  std::fprintf(stderr, "%s\n", result.error().sentence().c_str());
  std::exit(1);
}
inline void or_exit(const bodice::engine::Result<void>& result) {
  if (result) return;
  std::fprintf(stderr, "%s\n", result.error().sentence().c_str());
  std::exit(1);
}

}  // namespace bench
