#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/log_sinks.hpp>
#include <bodice_test/temp_folder.hpp>

using namespace bodice::engine;

TEST_CASE("the host's callback gets the message and its level, from the least level on") {
  std::vector<std::pair<LogLevel, std::string>> lines;
  const auto log = make_callback_log(
      [&](LogLevel level, std::string_view message) { lines.emplace_back(level, message); });
  Context context{.log = log.get()};
  context.info("welded 12 vertices {not a format}");
  context.warn("hands touch the thighs");
  log->write(LogLevel::kDebug, "below the least level");
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] == std::pair{LogLevel::kInfo, std::string("welded 12 vertices {not a format}")});
  CHECK(lines[1].first == LogLevel::kWarning);
}

TEST_CASE("an exception of the host's callback, of any type, does not reach the library") {
  int calls = 0;
  const auto log = make_callback_log([&](LogLevel, std::string_view) {
    if (++calls == 1) throw std::runtime_error("sink is broken");
    throw calls;  // a host need not throw std::exception
  });
  CHECK_NOTHROW(log->write(LogLevel::kError, "first"));
  CHECK_NOTHROW(log->write(LogLevel::kError, "second"));
  CHECK_NOTHROW(log->write(LogLevel::kError, "third"));
  CHECK(calls == 3);
}

TEST_CASE("a log file holds one line a message; a folder is refused with a sentence") {
  const bodice_test::TempFolder folder;
  const auto path = folder / "log.txt";
  {
    auto log = make_file_log(path);
    REQUIRE(log.ok());
    log.value()->write(LogLevel::kWarning, "one");
  }
  std::ifstream file(path);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  CHECK(text.find("[warning] one\n") != std::string::npos);

  const auto refused = make_file_log(folder.path());
  REQUIRE(!refused.ok());
  CHECK(refused.error().code == ErrorCode::kWriteFailed);
}
