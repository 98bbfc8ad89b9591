// Logs for a program's Context: spdlog behind engine::Log.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

#include <bodice/engine/log.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::engine {

/// Writes lines `[12:34:56.789] [info] message` to the standard error stream, colored on a terminal.
std::unique_ptr<Log> make_stderr_log(LogLevel least = LogLevel::kInfo);

/// Appends such lines to a file, which is flushed at every warning and error. Fails with kWriteFailed.
Result<std::unique_ptr<Log>> make_file_log(const std::filesystem::path& path,
                                           LogLevel least = LogLevel::kInfo);

/// Passes each message of at least `least` to the host, one call at a time. An exception from the callback is
/// dropped, so that logging never changes what the library does.
std::unique_ptr<Log> make_callback_log(std::function<void(LogLevel, std::string_view)> callback,
                                       LogLevel least = LogLevel::kInfo);

}  // namespace bodice::engine
