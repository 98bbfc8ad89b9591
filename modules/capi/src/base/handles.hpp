// Checks that functions of the interface begin with.
#pragma once

#include "base/outcome.hpp"

namespace bodice::inline v0_1::capi {

/// The failure of a handle that is null, or success.
inline Outcome check_handle(const void* handle, const char* what) {
  if (handle) return {};
  return invalid(std::string(what) + " is null.", "Pass the handle that a call has made.");
}

/// Empties the result of a call that makes a handle; fails if there is no room for it.
template <class T>
Outcome begin_result(T** out, const char* what) {
  if (!out)
    return invalid(std::string("The pointer to ") + what + " is null.", "Pass the address of a handle.");
  *out = nullptr;
  return {};
}

/// Leaves a function with the failure of a check.
#define BODICE_CHECK(check)                                                       \
  do {                                                                            \
    if (::bodice::capi::Outcome checked = (check); !checked.ok()) return checked; \
  } while (false)

}  // namespace bodice::capi
