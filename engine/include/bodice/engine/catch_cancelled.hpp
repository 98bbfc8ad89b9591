#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <bodice/engine/cancel.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::engine {

/// The Result that `work()` returns, or kCancelled where a checkpoint in it throws Cancelled: what each
/// public function that takes a Context and returns a Result ends with. `what` begins the sentence: "The fit"
/// was cancelled.
template <class Work>
std::invoke_result_t<Work> catch_cancelled(std::string_view what, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const Cancelled&) {
    return Error{ErrorCode::kCancelled, std::string(what) + " was cancelled.", ""};
  }
}

}  // namespace bodice::engine
