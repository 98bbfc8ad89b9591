#pragma once

#include <string_view>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// The weight of a message, from the least to the most.
enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// The destination of messages. The library never prints: without a Log in the Context, messages are dropped.
class Log {
 public:
  virtual ~Log() = default;
  /// Thread-safe. `message` is one line without a newline.
  virtual void write(LogLevel level, std::string_view message) = 0;
};

}  // namespace bodice::engine
