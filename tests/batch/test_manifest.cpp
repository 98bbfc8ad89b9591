// Manifests: JSON lines and CSV, broken lines, a million lines.
#include <doctest/doctest.h>

#include <chrono>
#include <fstream>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fake_work.hpp"

using namespace bodice;
using bodice_test::BatchFolder;

TEST_CASE("a CSV manifest gives the results of the same jobs as JSON lines") {
  BatchFolder folder({"\xEF\xBB\xBF"
                      R"(n,body,"do",bytes)",
                      "1,a.obj,,", R"("2",a.obj,"fail",)", "", "3,,,5\r"},
                     "jobs.csv");
  folder.write("a.obj", "a body");
  auto result = folder.run();
  REQUIRE(result.ok());
  CHECK(result->end.total == 3);
  CHECK(result->end.done == 2);
  auto log = folder.log(result->log);
  CHECK(log[3]["outcome"] == "failed");
  CHECK(log[5]["outcome"] == "done");
  const auto results = folder.results();
  BatchFolder same({R"({"n": 1, "body": "a.obj"})", "", R"({"bytes": 5, "n": 3})"});
  same.write("a.obj", "a body");
  REQUIRE(same.run().ok());
  CHECK(same.results() == results);
}

TEST_CASE("CSV lines with too many fields or an open quote are named, and the others are done") {
  BatchFolder folder({"n,do", "1,", "2,,3", R"(4,"fa)", "5,"}, "jobs.csv");
  const auto result = folder.run();
  REQUIRE(result.ok());
  CHECK(result->end.done == 2);
  auto log = folder.log(result->log);
  CHECK(log[3]["reason"].get<std::string>().find("3 fields") != std::string::npos);
  CHECK(log[4]["reason"].get<std::string>().find("jobs.csv:4") != std::string::npos);
}

TEST_CASE("a manifest that is missing, a folder or a pipe fails in one sentence") {
  BatchFolder folder({});
  for (const std::filesystem::path& manifest :
       {folder / "missing.jsonl", folder / ".", std::filesystem::path("/dev/null")}) {
    const auto result = batch::run_batch(folder.work, {.manifest = manifest, .out = folder / "out"});
    REQUIRE_FALSE(result.ok());
    CHECK(result.error().message.find(manifest.string()) != std::string::npos);
  }
  const auto empty = folder.run();
  REQUIRE(empty.ok());
  CHECK(empty->end.total == 0);
}

TEST_CASE("a file without any job, such as a mesh, is refused for its first line, and nothing is written") {
  for (const std::string name : {"body.obj", "jobs.csv"}) {
    BatchFolder folder({"v 0 0 0", "v 1,0 0", "f 1,2 3"}, name);
    const auto result = folder.run();
    REQUIRE_FALSE(result.ok());
    CHECK(result.error().message.find("There is no job in the manifest.") != std::string::npos);
    CHECK(result.error().message.find(name + (name == "jobs.csv" ? ":2: " : ":1: ")) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "out" / "log"));
  }
}

TEST_CASE("lines of any bytes are jobs or are named") {
  const std::string deep(900'000, '[');
  const std::string long_line = R"({"n": ")" + std::string(2'000'000, 'x') + "\"}";
  BatchFolder folder({R"({"n": "\u00e9\u0001"})", std::string("{\"n\": \"\xff\xfe\"}"), deep, long_line,
                      "[1]", "7", R"({"n": [[1]]})", R"({"n": 8})"});
  const auto result = folder.run();
  REQUIRE(result.ok());
  CHECK(result->end.done == 2);
  CHECK(result->end.failed == 6);
  CHECK(folder.log(result->log)[4]["reason"].get<std::string>().find("megabyte") != std::string::npos);
}

TEST_CASE("a million lines start in under ten seconds and 200 MB, and a broken one of them is named") {
  constexpr int kLines = 1'000'000, kBroken = 500'000;
  BatchFolder folder({});
  {
    std::ofstream manifest(folder / "jobs.jsonl");
    for (int line = 1; line <= kLines; ++line)
      if (line == kBroken)
        manifest << "{\"n\": broken}\n";
      else
        manifest << R"({"prepare": "body )" << line % 1000 << R"(", "n": )" << line
                 << R"(, "do": "", "bytes": 3})"
                 << "\n";
  }
  // The broken line shares nothing, so that the last shard has it.
  const pid_t batch = ::fork();
  if (batch == 0) {
    const auto result = folder.run({.shard = 99'999, .shards = 100'000});
    ::_exit(result.ok() && result->end.lines == kLines && result->end.done == 9 && result->end.failed == 1
                ? 0
                : 1);
  }
  const auto begin = std::chrono::steady_clock::now();
  int status = 0;
  rusage usage = {};
  REQUIRE(::wait4(batch, &status, 0, &usage) == batch);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 0));
  const double cpu_s =
      static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
  MESSAGE("a million lines: ", took.count(), " s, of a core ", cpu_s, " s, ", usage.ru_maxrss / 1024, " MiB");
  if (!bodice_test::kSanitized) {
    CHECK(cpu_s < 10.0);
    CHECK(usage.ru_maxrss < 200'000'000 / 1024);
  }
  CHECK(folder.results().size() == 9);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out/log")) {
    auto log = folder.log(entry.path());
    CHECK(log[kBroken]["reason"].get<std::string>().find("jobs.jsonl:500000") != std::string::npos);
  }
}
