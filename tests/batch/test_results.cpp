// Results: named by their content, whole or absent, computed once.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fake_work.hpp"

using namespace bodice;
using bodice_test::BatchFolder;
using Lines = std::vector<std::string>;

TEST_CASE("a batch that runs again computes nothing, and something new alone") {
  BatchFolder folder({R"({"n": 1})", R"({"n": 2})"});
  folder.work.ran = folder / "ran";
  REQUIRE(folder.run().ok());
  const auto again = folder.run();
  REQUIRE(again.ok());
  CHECK(again->end.there == 2);
  CHECK(again->end.done == 0);
  folder.write("jobs.jsonl", "{\"n\": 3}\n{\"n\": 2}\n");
  const auto more = folder.run();
  REQUIRE(more.ok());
  CHECK(more->end.there == 1);
  CHECK(more->end.done == 1);
  CHECK(folder.read(folder / "ran").size() == 3);
}

TEST_CASE("a result is named by the bytes of files, the values and the version, and by nothing else") {
  BatchFolder folder({R"({"n": 1, "body": "a.obj"})"});
  folder.write("a.obj", "one body");
  folder.write("copy.obj", "one body");
  REQUIRE(folder.run().ok());
  CHECK(folder.results().size() == 1);
  // These lines differ in the name of the file, the order of the members, and the form of the number, and
  // name the same result.
  for (const char* same :
       {R"({"n": 1, "body": "copy.obj"})", R"({"body": "a.obj", "n": 1})", R"({"body": "./a.obj", "n": "1"})",
        R"({"body": ["a.obj"], "n": 1.0, "do": null})"}) {
    folder.write("jobs.jsonl", same);
    const auto result = folder.run();
    REQUIRE(result.ok());
    CAPTURE(same);
    CHECK(result->end.there == 1);
  }
  folder.write("jobs.jsonl", R"({"n": 1, "body": "a.obj"})");
  folder.write("a.obj", "another body");
  REQUIRE(folder.run().ok());
  CHECK(folder.results().size() == 2);
  folder.work.of_version = "fake 2";
  REQUIRE(folder.run().ok());
  CHECK(folder.results().size() == 3);
}

TEST_CASE(
    "a result is named by the files beside a file, too, and a job without one of them fails by its name") {
  BatchFolder folder({R"({"n": 1, "body": "a.gltf"})"});
  folder.write("a.gltf", "one body\n+ a.bin\n+ b.bin");
  folder.write("a.bin", "its points");
  folder.write("b.bin", "its weights");
  REQUIRE(folder.run().ok());
  CHECK(folder.results().size() == 1);
  CHECK(folder.run()->end.there == 1);
  folder.write("b.bin", "other weights");
  CHECK(folder.run()->end.done == 1);
  CHECK(folder.results().size() == 2);
  std::filesystem::remove(folder / "a.bin");
  const auto without = folder.run();
  REQUIRE(without.ok());
  CHECK(without->end.failed == 1);
  const auto log = folder.log(without->log);
  CHECK(log.begin()->second["reason"].get<std::string>().find("a.bin' cannot be opened") !=
        std::string::npos);
}

TEST_CASE("jobs that share a body take its step once, wherever they stand in the manifest") {
  Lines lines;
  for (int n = 0; n < 12; ++n)
    lines.push_back(R"({"n": )" + std::to_string(n) + R"(, "prepare": "body )" + std::to_string(n % 3) +
                    R"("})");
  BatchFolder folder(lines);
  folder.work.prepared = folder / "prepared";
  REQUIRE(folder.run().ok());
  CHECK(folder.results().size() == 12);
  CHECK(folder.read(folder / "prepared").size() == 3);
}

TEST_CASE("shards do each line once, share bodies, and are the same when the batch goes on") {
  Lines lines;
  for (int n = 0; n < 50; ++n)
    lines.push_back(R"({"n": )" + std::to_string(n) + R"(, "prepare": "body )" + std::to_string(n % 10) +
                    R"("})");
  lines[17] = "broken";
  BatchFolder folder(lines);
  folder.work.prepared = folder / "prepared";
  std::set<std::size_t> seen;
  for (std::size_t shard = 0; shard < 7; ++shard) {
    std::vector<std::size_t> first;
    for (int go = 0; go < 2; ++go) {
      const auto result = folder.run({.shard = shard, .shards = 7});
      REQUIRE(result.ok());
      std::vector<std::size_t> now;
      for (const auto& [line, about] : folder.log(result->log)) now.push_back(line);
      if (go == 0) {
        first = now;
        for (const std::size_t line : now) CHECK(seen.insert(line).second);
      }
      CHECK(now == first);
      CHECK((now.size() == 7 || now.size() == 8));
    }
  }
  CHECK(seen.size() == 50);
  CHECK(folder.results().size() == 49);
  CHECK(folder.read(folder / "prepared").size() <= 10 + 6);
  CHECK_FALSE(folder.run({.shard = 7, .shards = 7}).ok());
}

TEST_CASE("two batches on one folder at once are both right, and leave each result once") {
  Lines lines;
  for (int n = 0; n < 30; ++n) lines.push_back(R"({"n": )" + std::to_string(n) + "}");
  BatchFolder folder(lines);
  std::vector<pid_t> batches;
  for (int i = 0; i < 3; ++i) {
    batches.push_back(::fork());
    if (batches.back() == 0) {
      const auto result = folder.run();
      ::_exit(result.ok() && result->end.failed == 0 && result->end.done + result->end.there == 30 ? 0 : 1);
    }
  }
  for (const pid_t batch : batches) {
    int status = 0;
    REQUIRE(::waitpid(batch, &status, 0) == batch);
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 0));
  }
  std::set<std::string> values;
  for (const auto& [key, value] : folder.results()) values.insert(value);
  CHECK(values.size() == 30);
  CHECK(folder.results().size() == 30);
  CHECK(folder.parts() == 0);
}

TEST_CASE("a batch that is killed loses the running jobs, and goes on from there") {
  Lines lines;
  for (int n = 0; n < 40; ++n) lines.push_back(R"({"do": "sleep", "n": )" + std::to_string(n) + "}");
  BatchFolder folder(lines);
  const pid_t batch = ::fork();
  if (batch == 0) {
    static_cast<void>(folder.run({.jobs = 20}));
    ::_exit(0);
  }
  // Jobs that have started say nothing of results that are written: on a busy machine those come much later.
  while (!std::filesystem::exists(folder / "out") || folder.results().size() < 10)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(batch, SIGKILL);
  ::waitpid(batch, nullptr, 0);
  for (const auto& [key, value] : folder.results()) CHECK(value != "half");
  CHECK(folder.results().size() >= 10);
  CHECK(folder.results().size() < 40);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // its children end with it
  const std::size_t before = folder.results().size();
  const auto result = folder.run({.jobs = 20});
  REQUIRE(result.ok());
  CHECK(result->end.there == before);
  CHECK(folder.results().size() == 40);
  CHECK(folder.parts() == 0);
}

TEST_CASE("a batch that is canceled ends at once, whatever its jobs do, and leaves nothing half-written") {
  BatchFolder folder({R"({"n": 1, "do": "hang"})", R"({"n": 2, "prepare": "hang"})", R"({"n": 3})"});
  engine::CancelSource stop;
  batch::BatchOptions options{.manifest = folder / "jobs.jsonl", .out = folder / "out", .jobs = 2};
  options.cancel = stop.token();
  const auto begin = std::chrono::steady_clock::now();
  const auto result = batch::run_batch(folder.work, options, [&](const batch::BatchProgress&) {
    if (std::chrono::steady_clock::now() - begin > std::chrono::milliseconds(300)) stop.cancel();
  });
  REQUIRE(result.ok());
  CHECK(result->canceled);
  CHECK(result->end.finished() == 0);
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(3));
  CHECK(folder.parts() == 0);
  CHECK(folder.results().empty());
}

TEST_CASE("a full disk ends the batch with its name, and the batch goes on once there is space") {
  BatchFolder folder({R"({"n": 1})", R"({"n": 2, "bytes": 9000000})", R"({"n": 3})"});
  std::filesystem::create_directory(folder / "out");
  if (::mount("none", (folder / "out").c_str(), "tmpfs", 0, "size=2m") != 0) {
    MESSAGE("skipped: only root mounts a small disk");
    return;
  }
  auto result = folder.run({.jobs = 1});
  CHECK(result.ok());  // one job was too large, and there is space for others
  if (result.ok()) CHECK(folder.log(result->log)[2]["failure"] == "write");
  CHECK(folder.results().size() == 2);
  folder.write("out/ballast", std::string(4'000'000, '.'));
  folder.write("jobs.jsonl", "{\"n\": 4, \"bytes\": 100000}\n{\"n\": 5}\n");
  result = folder.run({.jobs = 1});
  CHECK_FALSE(result.ok());
  if (!result.ok()) {
    CHECK(result.error().code == engine::ErrorCode::kWriteFailed);
    CHECK(result.error().sentence().find("space") != std::string::npos);
  }
  CHECK(folder.results().size() == 2);
  std::filesystem::remove(folder / "out/ballast");
  result = folder.run({.jobs = 1});
  CHECK(result.ok());
  CHECK(folder.results().size() == 4);
  CHECK(folder.parts() == 0);
  CHECK(::umount((folder / "out").c_str()) == 0);
}
