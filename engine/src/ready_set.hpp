#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bodice::inline v0_1::engine {

/// A set of small numbers from which any thread takes the least one, without a lock and without waiting.
/// Every member except resize() may be called at any time by any thread.
class ReadySet {
 public:
  void resize(std::size_t size) {
    leaves_ = std::vector<Word>(words(size));
    summary_ = std::vector<Word>(words(leaves_.size()));
  }

  void insert(std::size_t number) {
    leaves_[number / 64].fetch_or(bit(number));
    mark(number / 64);
  }

  /// Returns false if the set was empty at some moment of the call.
  bool take_least(std::size_t& number) {
    for (std::size_t s = 0; s < summary_.size(); ++s) {
      for (std::uint64_t marks = summary_[s].load(); marks != 0; marks &= marks - 1) {
        const std::size_t leaf = 64 * s + static_cast<std::size_t>(std::countr_zero(marks));
        if (take_from(leaf, number)) return true;
      }
    }
    return false;
  }

  std::size_t count() const {
    std::size_t all = 0;
    for (std::size_t s = 0; s < summary_.size(); ++s) {
      for (std::uint64_t marks = summary_[s].load(); marks != 0; marks &= marks - 1) {
        const std::size_t leaf = 64 * s + static_cast<std::size_t>(std::countr_zero(marks));
        all += static_cast<std::size_t>(std::popcount(leaves_[leaf].load()));
      }
    }
    return all;
  }
  bool empty() const { return count() == 0; }

  void clear() {
    for (Word& word : leaves_) word = 0;
    for (Word& word : summary_) word = 0;
  }

 private:
  using Word = std::atomic<std::uint64_t>;
  static std::size_t words(std::size_t bits) { return (bits + 63) / 64; }
  static std::uint64_t bit(std::size_t number) { return std::uint64_t{1} << (number % 64); }

  void mark(std::size_t leaf) {
    Word& word = summary_[leaf / 64];
    if ((word.load() & bit(leaf)) == 0) word.fetch_or(bit(leaf));
  }

  bool take_from(std::size_t leaf, std::size_t& number) {
    Word& word = leaves_[leaf];
    for (;;) {
      for (std::uint64_t bits = word.load(); bits != 0;) {
        const std::uint64_t least = bits & (~bits + 1);
        const std::uint64_t before = word.fetch_and(~least);
        if (before & least) {
          number = 64 * leaf + static_cast<std::size_t>(std::countr_zero(least));
          return true;
        }
        bits = before & ~least;
      }
      // A number may be inserted between the test and the unmarking, while the inserting thread still sees
      // the mark.
      summary_[leaf / 64].fetch_and(~bit(leaf));
      if (word.load() == 0) return false;
      mark(leaf);
    }
  }

  std::vector<Word> leaves_;   // one bit a number
  std::vector<Word> summary_;  // one bit a leaf, set if the leaf is not empty or was not a moment ago
};

}  // namespace bodice::engine
