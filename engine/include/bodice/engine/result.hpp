// Errors as values: a code, one sentence that names what is wrong, and the remedy.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// The kind of an error, for programs.
enum class ErrorCode {
  kInvalidArgument,   ///< An option or parameter is out of its documented range.
  kNotFound,          ///< A file, mesh or name does not exist.
  kUnreadable,        ///< A file exists but cannot be parsed.
  kUnusableGeometry,  ///< The input parsed, but no usable result can be made from it.
  kCanceled,          ///< The caller canceled the work.
  kWriteFailed,       ///< An output could not be written; nothing was left behind.
  kInternal,          ///< A broken invariant inside bodice.
};

/// A failure as people read it: `message` names the file and the element, `remedy` what to change.
struct Error {
  ErrorCode code = ErrorCode::kInternal;
  std::string message;
  std::string remedy;

  /// The message, then the remedy if there is one, on one line.
  std::string sentence() const { return remedy.empty() ? message : message + " " + remedy; }
};

/// Either a value or an Error. `Result<void>` carries success alone.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const noexcept { return state_.index() == 0; }
  explicit operator bool() const noexcept { return ok(); }

  /// Precondition: ok().
  T& value() & {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  const T& value() const& {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  T&& value() && {
    assert(ok());
    return std::move(*std::get_if<0>(&state_));
  }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  /// Precondition: !ok().
  const Error& error() const& {
    assert(!ok());
    return *std::get_if<1>(&state_);
  }
  Error&& error() && {
    assert(!ok());
    return std::move(*std::get_if<1>(&state_));
  }

 private:
  std::variant<T, Error> state_;
};

/// The outcome of a call without a value: success, or an error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)), ok_(false) {}
  bool ok() const noexcept { return ok_; }
  explicit operator bool() const noexcept { return ok_; }
  const Error& error() const {
    assert(!ok_);
    return error_;
  }

 private:
  Error error_;
  bool ok_ = true;
};

/// The work went on; the warning states what was dropped, repaired or doubtful, and the remedy.
struct Warning {
  std::string code;     ///< Stable, kebab-case: "hands-fused-to-thighs".
  std::string part;     ///< The body part, mesh or element concerned; may be empty.
  std::string message;  ///< One sentence.
  std::string remedy;   ///< One sentence; may be empty.
  /// A statement of what was done or found: nothing puts the result in doubt. False: the result may be wrong.
  bool note = false;

  std::string sentence() const {
    return (note ? "Note: " : "") + message + (remedy.empty() ? "" : " " + remedy);
  }
};

/// A warning that is a statement alone.
inline Warning note(std::string code, std::string part, std::string message, std::string remedy) {
  return {std::move(code), std::move(part), std::move(message), std::move(remedy), true};
}

/// The time that a named stage took. Lists of them are in the order in which the stages ended.
struct StageTime {
  std::string name;
  double ms = 0.0;
};

}  // namespace bodice::engine
