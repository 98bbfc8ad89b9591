// The log of a run: a line for the run, then a line for each job.
#pragma once

#include <filesystem>

#include <bodice/engine/json.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::batch {

/// A file of JSON lines that only one run writes. A line is written whole, at once: a run that is killed
/// leaves complete lines.
class Log {
 public:
  /// Makes a new file in the folder. `name` distinguishes runs of one second and process. Fails with
  /// kWriteFailed.
  static engine::Result<Log> open(const std::filesystem::path& folder, const std::string& name);
  Log(Log&& other) noexcept;
  Log& operator=(Log&&) = delete;
  ~Log();
  const std::filesystem::path& file() const { return file_; }
  engine::Result<void> add(const engine::SortedJson& line);

 private:
  Log(std::filesystem::path file, int descriptor);
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace bodice::batch
