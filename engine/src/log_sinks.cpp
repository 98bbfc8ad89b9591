#include <bodice/engine/log_sinks.hpp>

#include <mutex>

#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

namespace bodice::inline v0_1::engine {
namespace {

spdlog::level::level_enum to_spdlog(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return spdlog::level::debug;
    case LogLevel::kInfo:
      return spdlog::level::info;
    case LogLevel::kWarning:
      return spdlog::level::warn;
    case LogLevel::kError:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

LogLevel from_spdlog(spdlog::level::level_enum level) {
  if (level >= spdlog::level::err) return LogLevel::kError;
  if (level == spdlog::level::warn) return LogLevel::kWarning;
  return level == spdlog::level::info ? LogLevel::kInfo : LogLevel::kDebug;
}

class CallbackSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit CallbackSink(std::function<void(LogLevel, std::string_view)> callback)
      : callback_(std::move(callback)) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    // spdlog catches only std::exception, and a job that logs is noexcept.
    try {
      callback_(from_spdlog(message.level), {message.payload.data(), message.payload.size()});
    } catch (...) {
    }
  }
  void flush_() override {}

  std::function<void(LogLevel, std::string_view)> callback_;
};

// The logger is outside of spdlog's global registry.
class SpdlogLog final : public Log {
 public:
  SpdlogLog(spdlog::sink_ptr sink, LogLevel least) : logger_("bodice", std::move(sink)) {
    logger_.set_level(to_spdlog(least));
    logger_.flush_on(spdlog::level::warn);
    logger_.set_pattern("[%H:%M:%S.%e] [%l] %v");
    // spdlog would print its own failures. A library must not, and a full disk must not stop a fit.
    logger_.set_error_handler([](const std::string&) {});
  }
  void write(LogLevel level, std::string_view message) override {
    logger_.log(to_spdlog(level), spdlog::string_view_t(message.data(), message.size()));
  }

 private:
  spdlog::logger logger_;
};

}  // namespace

std::unique_ptr<Log> make_stderr_log(LogLevel least) {
  return std::make_unique<SpdlogLog>(std::make_shared<spdlog::sinks::stderr_color_sink_mt>(), least);
}

Result<std::unique_ptr<Log>> make_file_log(const std::filesystem::path& path, LogLevel least) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path.string());
    return std::unique_ptr<Log>(std::make_unique<SpdlogLog>(std::move(sink), least));
  } catch (const spdlog::spdlog_ex&) {
    return Error{ErrorCode::kWriteFailed, "Cannot open the log file '" + path.string() + "'.",
                 "Check that the folder can be written to."};
  }
}

std::unique_ptr<Log> make_callback_log(std::function<void(LogLevel, std::string_view)> callback,
                                       LogLevel least) {
  return std::make_unique<SpdlogLog>(std::make_shared<CallbackSink>(std::move(callback)), least);
}

}  // namespace bodice::engine
