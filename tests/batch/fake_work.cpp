#include "fake_work.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include <doctest/doctest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bodice/engine/write_file.hpp>

namespace bodice_test {
namespace {

namespace fs = std::filesystem;
using namespace bodice;
using engine::Error;
using engine::ErrorCode;

/// Adds a byte to a file, as a whole, so that processes can count.
void count_in(const fs::path& file) {
  if (file.empty()) return;
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
  REQUIRE(::write(descriptor, ".", 1) == 1);
  ::close(descriptor);
}

/// Does what a job requests. Returns the error it requests, or success.
engine::Result<void> obey(const std::string& wish, const fs::path& counter) {
  if (wish == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
  if (wish == "sleep") std::this_thread::sleep_for(std::chrono::milliseconds(300));
  if (wish == "crash") ::raise(SIGSEGV);
  if (wish == "abort") ::abort();
  if (wish == "exit") ::_exit(3);
  if (wish == "killed") ::raise(SIGKILL);
  if (wish == "throw") throw std::runtime_error("a bolt from the blue");
  if (wish == "crash once" && fs::file_size(counter) < 2) ::raise(SIGSEGV);
  if (wish == "fail") return Error{ErrorCode::kUnreadable, "The body is corrupt.", "Mend it."};
  if (wish == "allocate" || wish == "allocate and wrap") {
    try {
      std::vector<char> much(std::size_t{400} << 20, 'x');
      if (much[12345] != 'x') return Error{ErrorCode::kInternal, "", ""};
    } catch (const std::bad_alloc&) {
      if (wish == "allocate") throw;
      return Error{ErrorCode::kUnreadable, "A library gives up.", ""};
    }
  }
  return {};
}

}  // namespace

std::vector<fs::path> FakeWork::files_beside(const fs::path& file) const {
  std::vector<fs::path> files;
  std::ifstream text(file);
  for (std::string line; std::getline(text, line);)
    if (line.starts_with("+ ")) files.push_back(file.parent_path() / line.substr(2));
  return files;
}

namespace {

class FakePrepared : public batch::PreparedJobs {
 public:
  explicit FakePrepared(const FakeWork& work) : work_(work) {}
  engine::Result<batch::JobFacts> run(const batch::Job& job, const fs::path& folder) override {
    count_in(work_.ran);
    auto half = engine::write_file(folder / "value.txt", std::string_view("half"));
    if (!half) return std::move(half).error();
    if (auto done = obey(job.value("do"), work_.ran); !done) return std::move(done).error();
    const std::string big(static_cast<std::size_t>(std::atoi(job.value("bytes").c_str())), '.');
    auto written = engine::write_file(folder / "value.txt", std::string_view(job.value("n") + big));
    if (!written) return std::move(written).error();
    return batch::JobFacts{.seed = 7,
                           .warnings = {{"odd", "", "It looks odd.", "Look."}},
                           .numbers = {{"error_mm", std::atof(job.value("n").c_str())}}};
  }

 private:
  const FakeWork& work_;
};

}  // namespace

engine::Result<void> FakeWork::check(const batch::Job& job) const {
  for (const auto& [name, values] : job.values)
    if (name != "body" && name != "n" && name != "do" && name != "prepare" && name != "bytes")
      return Error{ErrorCode::kInvalidArgument, "'" + name + "' is no name.", "Leave it out."};
  return {};
}

engine::Result<std::unique_ptr<batch::PreparedJobs>> FakeWork::prepare(const batch::Job& first) {
  count_in(prepared);
  if (auto done = obey(first.value("prepare"), prepared); !done) return std::move(done).error();
  return std::unique_ptr<batch::PreparedJobs>(std::make_unique<FakePrepared>(*this));
}

BatchFolder::BatchFolder(const std::vector<std::string>& lines, const std::string& name) : manifest_(name) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  write(name, text);
}

void BatchFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string BatchFolder::read(const fs::path& file) const {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

engine::Result<batch::BatchResult> BatchFolder::run(batch::BatchOptions options) {
  options.manifest = folder_ / manifest_;
  options.out = folder_ / "out";
  if (options.jobs == 0) options.jobs = 2;
  return batch::run_batch(work, options);
}

std::map<std::size_t, nlohmann::json> BatchFolder::log(const fs::path& file) const {
  std::map<std::size_t, nlohmann::json> lines;
  std::ifstream stream(file);
  std::string text;
  REQUIRE(std::getline(stream, text));
  CHECK(nlohmann::json::parse(text).contains("run"));
  while (std::getline(stream, text)) {
    auto line = nlohmann::json::parse(text);
    const auto number = line.at("line").get<std::size_t>();
    CHECK_MESSAGE(!lines.contains(number), "line ", number, " stands twice");
    lines[number] = std::move(line);
  }
  return lines;
}

std::map<std::string, std::string> BatchFolder::results() const {
  std::map<std::string, std::string> found;
  for (const auto& group : fs::directory_iterator(folder_ / "out")) {
    if (group.path().filename().string().size() != 2) continue;
    for (const auto& result : fs::directory_iterator(group))
      found[result.path().filename().string()] = read(result.path() / "value.txt");
  }
  return found;
}

std::size_t BatchFolder::parts() const {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_ / "out/part"), {}));
}

}  // namespace bodice_test
