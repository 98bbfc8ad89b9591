#pragma once

namespace bodice_bench {

/// Keeps the calling thread on one of its processors (modulo their number) during the lifetime of this
/// object. Does nothing where the system has no such call.
class Pinned {
 public:
  explicit Pinned(int processor);
  ~Pinned();
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;

 private:
  struct Mask;
  Mask* before_ = nullptr;
};

}  // namespace bodice_bench
