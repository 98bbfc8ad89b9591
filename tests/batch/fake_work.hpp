// Work that takes no time, and does what its jobs request: hang, crash, allocate, fail.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <bodice/batch/batch.hpp>
#include <bodice_test/temp_folder.hpp>

namespace bodice_test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;  // shadow memory counts as data, signals are taken, all is slower
#else
inline constexpr bool kSanitized = false;
#endif

/// Jobs have `body` (a file), `n`, and `do`: what run() does, or `prepare`: what prepare() does.
class FakeWork : public bodice::batch::Work {
 public:
  std::string of_version = "fake 1";
  std::filesystem::path prepared;  ///< each call of prepare() adds a byte to this file, if it is named
  std::filesystem::path ran;       ///< each call of run() does

  std::string version() const override { return of_version; }
  bool is_file(const std::string& name, const std::string&) const override { return name == "body"; }
  /// A file's `+ NAME` lines name files beside it.
  std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file) const override;
  std::string shared(const bodice::batch::Job& job) const override {
    return job.value("body") + "|" + job.value("prepare");
  }
  bodice::engine::Result<void> check(const bodice::batch::Job& job) const override;
  bodice::engine::Result<std::unique_ptr<bodice::batch::PreparedJobs>> prepare(
      const bodice::batch::Job& first) override;
};

/// A folder with a manifest, run into `out` beside it.
class BatchFolder {
 public:
  explicit BatchFolder(const std::vector<std::string>& lines, const std::string& name = "jobs.jsonl");
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::filesystem::path& file) const;
  /// Calls run_batch() with these options, but for manifest and folder.
  bodice::engine::Result<bodice::batch::BatchResult> run(bodice::batch::BatchOptions options = {});
  /// The lines of a log, by line of the manifest.
  std::map<std::size_t, nlohmann::json> log(const std::filesystem::path& file) const;
  /// All results, OUT/ab/ab12..., and what they hold in value.txt.
  std::map<std::string, std::string> results() const;
  /// How many folders are left unfinished.
  std::size_t parts() const;

  FakeWork work;

 private:
  TempFolder folder_;
  std::string manifest_;
};

}  // namespace bodice_test
