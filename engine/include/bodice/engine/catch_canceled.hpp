#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <bodice/engine/cancel.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::engine {

/// Returns what `work()` returns, or kCanceled if a checkpoint in it throws Canceled. Each public function
/// that takes a Context and returns a Result ends with it. `what` begins the error's sentence: "The fit" was
/// canceled.
template <class Work>
std::invoke_result_t<Work> catch_canceled(std::string_view what, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const Canceled&) {
    return Error{ErrorCode::kCanceled, std::string(what) + " was canceled.", ""};
  }
}

}  // namespace bodice::engine
