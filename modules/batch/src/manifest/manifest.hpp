// The jobs of a manifest in the order in which they run. Lines stay on the disk, and are read when they are
// due.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/batch/work.hpp>
#include <bodice/engine/cancel.hpp>

namespace bodice::inline v0_1::batch {

/// Which part of a manifest: `index` of `count`, from 0.
struct Shard {
  std::size_t index = 0, count = 1;
};

/// Jobs that share a step stand beside each other, in the order of the first of them; a shard is a range of
/// that order. It depends on the manifest alone, so that a run that goes on has the same shards.
class Manifest {
 public:
  /// Fails with kNotFound, kUnreadable (not a file, no first line of a CSV file) or kInvalidArgument (shard).
  static engine::Result<Manifest> open(const std::filesystem::path& file, const Work& work,
                                       const Shard& shard, const engine::CancelToken& cancel);
  Manifest(Manifest&& other) noexcept;
  Manifest& operator=(Manifest&&) = delete;
  ~Manifest();

  std::size_t lines() const { return lines_; }          ///< jobs of all shards; empty lines are none
  std::size_t size() const { return entries_.size(); }  ///< jobs of this shard
  std::size_t line_number(std::size_t i) const { return entries_[i].line; }
  /// Whether job i shares its step with job i - 1.
  bool continues(std::size_t i) const { return i > 0 && entries_[i].continues; }
  /// Fails where the line is broken; the sentence names it.
  engine::Result<Job> read(std::size_t i) const { return read_line(entries_[i].offset, entries_[i]); }
  /// Frees what only a batch as a whole needs, for its child processes. size() is zero from then on.
  void forget() { std::vector<Entry>().swap(entries_); }
  /// Where a job's line begins and how long it is, for read_at() after forget().
  std::string address(std::size_t i) const;
  engine::Result<Job> read_at(const std::string& address) const;

 private:
  struct Entry {
    std::uint64_t offset = 0;
    std::uint32_t length = 0;
    std::uint32_t line : 31 = 0;
    std::uint32_t continues : 1 = 0;
  };
  struct Index;
  Manifest(std::filesystem::path file, int descriptor, const Work& work);
  engine::Result<void> build(const Shard& shard, const engine::CancelToken& cancel);
  Index index_of(std::string_view line, std::size_t number, std::optional<engine::Error>& first_error) const;
  /// The lines that are not empty, in the order of the file.
  engine::Result<std::vector<Index>> index_lines(const engine::CancelToken& cancel);
  /// Sorts lines so that jobs that share a step stand beside each other, in the order of the first of them.
  static void order_by_share(std::vector<Index>& index);
  engine::Result<Job> parse(std::string_view line, std::size_t number) const;
  engine::Result<Job> read_line(std::uint64_t offset, const Entry& entry) const;

  std::filesystem::path file_;
  int descriptor_;
  const Work* work_;
  std::vector<std::string> columns_;  ///< names of a CSV file's columns
  bool is_csv_;
  std::size_t lines_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace bodice::batch
