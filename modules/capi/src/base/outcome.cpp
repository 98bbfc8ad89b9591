#include "base/outcome.hpp"

#include <cstdio>

namespace bodice::inline v0_1::capi {
namespace {

/// Each thread has its own, so that calls on different threads never meet.
thread_local char last_sentence[1024] = "";

bodice_status status_of(engine::ErrorCode code) {
  switch (code) {
    case engine::ErrorCode::kInvalidArgument:
      return BODICE_INVALID_ARGUMENT;
    case engine::ErrorCode::kNotFound:
      return BODICE_NOT_FOUND;
    case engine::ErrorCode::kUnreadable:
      return BODICE_UNREADABLE;
    case engine::ErrorCode::kUnusableGeometry:
      return BODICE_UNUSABLE_GEOMETRY;
    case engine::ErrorCode::kCanceled:
      return BODICE_CANCELED;
    case engine::ErrorCode::kWriteFailed:
      return BODICE_WRITE_FAILED;
    case engine::ErrorCode::kInternal:
      break;
  }
  return BODICE_INTERNAL;
}

}  // namespace

Outcome::Outcome(const engine::Error& error) : Outcome(status_of(error.code), error.sentence()) {}

Outcome invalid(const std::string& what, const std::string& remedy) {
  return {BODICE_INVALID_ARGUMENT, what + " " + remedy};
}

bodice_status finish(bodice_status status, const char* sentence) noexcept {
  std::snprintf(last_sentence, sizeof last_sentence, "%s", sentence);
  return status;
}

bodice_status finish(const Outcome& outcome) noexcept {
  return outcome.ok() ? BODICE_OK : finish(outcome.status(), outcome.sentence().c_str());
}

}  // namespace bodice::capi

const char* bodice_last_error(void) {
  return bodice::capi::last_sentence;
}

const char* bodice_status_name(bodice_status status) {
  static const char* const names[] = {"BODICE_OK",
                                      "BODICE_INVALID_ARGUMENT",
                                      "BODICE_NOT_FOUND",
                                      "BODICE_UNREADABLE",
                                      "BODICE_UNUSABLE_GEOMETRY",
                                      "BODICE_CANCELED",
                                      "BODICE_WRITE_FAILED",
                                      "BODICE_INTERNAL",
                                      "BODICE_OUT_OF_MEMORY",
                                      "BODICE_NOT_INITIALIZED",
                                      "BODICE_VERSION_MISMATCH"};
  return status >= 0 && status <= BODICE_VERSION_MISMATCH ? names[status] : "not a status of bodice";
}
