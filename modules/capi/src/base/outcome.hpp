// How calls end: a status for programs, a sentence for people. Nothing is thrown across the interface.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>

#include <bodice.h>

#include <bodice/engine/cancel.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::capi {

/// Success, or a status with its sentence.
class Outcome {
 public:
  Outcome() = default;
  Outcome(bodice_status status, std::string sentence) : status_(status), sentence_(std::move(sentence)) {}
  Outcome(const engine::Error& error);
  Outcome(const engine::Result<void>& result) : Outcome(result.ok() ? Outcome() : Outcome(result.error())) {}

  bool ok() const { return status_ == BODICE_OK; }
  bodice_status status() const { return status_; }
  const std::string& sentence() const { return sentence_; }

 private:
  bodice_status status_ = BODICE_OK;
  std::string sentence_;
};

/// A parameter that cannot be used: `what` is wrong, `remedy` mends it.
Outcome invalid(const std::string& what, const std::string& remedy);

/// Stores the sentence of a failure for bodice_last_error() and returns its status. Allocates nothing.
bodice_status finish(const Outcome& outcome) noexcept;
bodice_status finish(bodice_status status, const char* sentence) noexcept;

/// Runs the work of a function of the interface; whatever it throws becomes a status.
template <class Work>
bodice_status guarded(Work&& work) noexcept {
  try {
    return finish(Outcome(work()));
  } catch (const engine::Canceled&) {
    return finish(BODICE_CANCELED, "The host stopped the work.");
  } catch (const std::bad_alloc&) {
    return finish(BODICE_OUT_OF_MEMORY, "An allocation failed. Free memory, or pass fewer particles a call.");
  } catch (const std::exception& e) {
    return finish(BODICE_INTERNAL, e.what());
  } catch (...) {
    return finish(BODICE_INTERNAL, "An unknown exception was thrown inside bodice.");
  }
}

}  // namespace bodice::capi
