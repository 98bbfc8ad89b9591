// Jobs that fail, crash, hang and grow: each is a line of its own, and the others are done.
#include <doctest/doctest.h>

#include "fake_work.hpp"

using namespace bodice;
using bodice_test::BatchFolder;
using bodice_test::kSanitized;

TEST_CASE("a batch with jobs that fail in every manner names each and does the others") {
  BatchFolder folder({R"({"n": 1})", R"({"n": 2, "do": "hang"})", R"({"n": 3, "do": "crash"})",
                      R"({"n": 4, "do": "abort"})", R"({"n": 5, "do": "fail"})", R"({"n": 6, "do": "throw"})",
                      R"({"n": 7, "do": "exit"})", R"({"n": 8, "do": "killed"})", R"({"n": 9)",
                      R"({"n": 10, "color": "red"})", R"({"n": 11, "body": "missing.obj"})",
                      R"({"n": 12, "body": "."})", R"({"n": 13, "body": {"a": 1}})", R"({"n": 14})"});
  const auto result = folder.run({.timeout_s = 0.5});
  REQUIRE(result.ok());
  CHECK(result->end.done == 2);
  CHECK(result->end.failed == 12);
  CHECK(result->first_failures.size() == 10);
  auto log = folder.log(result->log);
  REQUIRE(log.size() == 14);
  CHECK(log[1]["outcome"] == "done");
  CHECK(log[14]["outcome"] == "done");
  const std::pair<std::size_t, const char*> kinds[] = {
      {2, "timeout"}, {3, "crash"}, {4, "crash"},  {5, "error"},  {6, "error"},  {7, "crash"},
      {8, "killed"},  {9, "error"}, {10, "error"}, {11, "error"}, {12, "error"}, {13, "error"}};
  for (const auto& [line, kind] : kinds) {
    CAPTURE(line);
    CHECK(log[line]["outcome"] == "failed");
    CHECK(log[line]["failure"] == kind);
  }
  const auto reason = [&log](std::size_t line) { return log[line]["reason"].get<std::string>(); };
  CHECK(reason(2).find("0.5 s") != std::string::npos);
  if (!kSanitized) CHECK(reason(3).find("SIGSEGV") != std::string::npos);
  CHECK(reason(5) == "The body is corrupt. Mend it.");
  CHECK(reason(6).find("bolt") != std::string::npos);
  CHECK(reason(9).find("jobs.jsonl:9") != std::string::npos);
  CHECK(reason(10).find("color") != std::string::npos);
  CHECK(reason(11).find("missing.obj") != std::string::npos);
  CHECK(reason(12).find("is not a file") != std::string::npos);
  CHECK(reason(13).find("body") != std::string::npos);
  CHECK(folder.results().size() == 2);
  CHECK(folder.parts() == 0);
}

TEST_CASE("a job beyond its memory is named so, whatever a library makes of the failure" *
          doctest::skip(kSanitized)) {
  BatchFolder folder({R"({"n": 1})", R"({"n": 2, "do": "allocate"})",
                      R"({"n": 3, "do": "allocate and wrap"})", R"({"n": 4, "prepare": "allocate"})"});
  const auto result = folder.run({.memory_mb = 300.0});
  REQUIRE(result.ok());
  auto log = folder.log(result->log);
  CHECK(log[1]["outcome"] == "done");
  for (const std::size_t line : {2, 3, 4}) {
    CAPTURE(line);
    CHECK(log[line]["failure"] == "memory");
    CHECK(log[line]["reason"].get<std::string>().find("300 MB") != std::string::npos);
  }
  const auto enough = folder.run({.memory_mb = 3000.0});
  REQUIRE(enough.ok());
  CHECK(enough->end.failed == 0);
  CHECK(folder.results().size() == 4);
}

TEST_CASE("a shared step that fails, hangs or crashes fails each of its jobs and no other") {
  for (const std::string wish : {"fail", "hang", "crash"}) {
    CAPTURE(wish);
    const std::string rest = R"(, "prepare": ")" + wish + R"("})";
    BatchFolder folder({R"({"n": 1})", R"({"n": 2)" + rest, R"({"n": 3)" + rest, R"({"n": 4)" + rest});
    folder.work.prepared = folder / "prepared";
    const auto result = folder.run({.timeout_s = 0.5});
    REQUIRE(result.ok());
    CHECK(result->end.done == 1);
    CHECK(result->end.failed == 3);
    auto log = folder.log(result->log);
    const std::string kind = wish == "fail" ? "error" : wish == "hang" ? "timeout" : "crash";
    for (const std::size_t line : {2, 3, 4}) CHECK(log[line]["failure"] == kind);
    CHECK(folder.read(folder / "prepared").size() == 2);  // it was not tried for each job
  }
}

TEST_CASE("another attempt is made of crashes, as often as wanted, and none of errors") {
  BatchFolder folder({R"({"n": 1, "do": "crash once"})"});
  folder.work.ran = folder / "ran";
  auto result = folder.run({.retry = 1});
  REQUIRE(result.ok());
  CHECK(result->end.done == 1);
  CHECK(folder.log(result->log)[1]["attempts"] == 2);

  BatchFolder failing({R"({"n": 1, "do": "crash"})", R"({"n": 2, "do": "fail"})"});
  failing.work.ran = failing / "ran";
  result = failing.run({.jobs = 1, .retry = 2});
  REQUIRE(result.ok());
  CHECK(result->end.failed == 2);
  CHECK(failing.log(result->log)[1]["attempts"] == 3);
  CHECK(failing.log(result->log)[2]["attempts"] == 1);
  CHECK(failing.read(failing / "ran").size() == 4);

  BatchFolder unprepared({R"({"n": 1, "prepare": "crash once"})", R"({"n": 2, "prepare": "crash once"})"});
  unprepared.work.prepared = unprepared / "prepared";
  result = unprepared.run({.retry = 1});
  REQUIRE(result.ok());
  CHECK(result->end.done == 2);
}

TEST_CASE("a device or a pipe in place of a body is refused and not waited for") {
  BatchFolder folder({R"({"n": 1, "body": "/dev/zero"})", R"({"n": 2})"});
  const auto result = folder.run();
  REQUIRE(result.ok());
  CHECK(result->end.failed == 1);
  CHECK(result->end.done == 1);
}
