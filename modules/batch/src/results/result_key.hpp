// The name of a job's result: a hash of the version, the job's values and the bytes of its files.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <bodice/batch/work.hpp>

namespace bodice::batch {

/// Hashes files, and each file once as long as its size and time stay the same.
class FileHashes {
 public:
  /// SHA-256 in hexadecimal. Fails with kNotFound, or kUnreadable where it is not a file or cannot be read.
  engine::Result<std::string> of(const std::filesystem::path& file);

 private:
  struct Known {
    long long size = 0, seconds = 0, nanoseconds = 0;
    std::string hash;
  };
  std::map<std::string, Known> known_;
};

/// 32 hexadecimal digits. Jobs with one key have the same result. Fails as FileHashes::of() does.
engine::Result<std::string> result_key(const Job& job, const Work& work, FileHashes& files);

}  // namespace bodice::batch
