// The name of a job's result: a hash of the version, the job's values and the bytes of its files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <bodice/batch/work.hpp>

namespace bodice::inline v0_1::batch {

/// Hashes files, and each file once as long as its size and time stay the same.
class FileHashes {
 public:
  /// SHA-256 in hexadecimal of a file, followed by those of the files beside it that hold a part of it. Fails
  /// with kNotFound, or kUnreadable where one is not a file or cannot be read.
  engine::Result<std::string> of(const std::filesystem::path& file, const Work& work);

 private:
  struct Known {
    long long size = 0, seconds = 0, nanoseconds = 0;
    std::string hash;
    std::vector<std::filesystem::path> beside;
  };
  /// Hashes one file if it is new or has changed, and then looks for the files beside it.
  engine::Result<Known> look_up(const std::filesystem::path& file, const Work* work);

  std::map<std::string, Known> known_;
};

/// 32 hexadecimal digits. Jobs with one key have the same result. Fails as FileHashes::of() does.
engine::Result<std::string> result_key(const Job& job, const Work& work, FileHashes& files);

}  // namespace bodice::batch
