// The folder of results: each result is a folder that appears whole or not at all.
#pragma once

#include <filesystem>
#include <string>

#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::batch {

/// OUT/ab/ab12... are results, OUT/log the logs, OUT/part what is being written.
class ResultStore {
 public:
  /// Makes the folders, and removes what ended processes of this machine left in OUT/part. Fails with
  /// kWriteFailed.
  static engine::Result<ResultStore> open(const std::filesystem::path& out);

  const std::filesystem::path& out() const { return out_; }
  std::filesystem::path logs() const { return out_ / "log"; }
  /// Relative to OUT.
  static std::string folder_of(const std::string& key) { return key.substr(0, 2) + "/" + key; }
  bool has(const std::string& key) const;

  /// A folder to write a result into, which no other process uses. Fails with kWriteFailed.
  engine::Result<std::filesystem::path> begin(const std::string& key) const;
  /// Makes it the result once its files are on the disk. Returns false, and removes it, where another process
  /// was first. Fails with kWriteFailed.
  engine::Result<bool> publish(const std::filesystem::path& part, const std::string& key) const;
  static void discard(const std::filesystem::path& part);
  /// Removes what ended processes of this machine left in OUT/part.
  void remove_leftovers() const;
  /// Whether the disk takes another result: a megabyte is written and removed.
  engine::Result<void> check_space() const;

 private:
  explicit ResultStore(std::filesystem::path out);
  std::filesystem::path out_;
};

/// The name of this machine, in a form for file names.
std::string host_name();

}  // namespace bodice::batch
