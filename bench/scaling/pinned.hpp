#pragma once

namespace bodice_bench {

/// The calling thread stays on one of the processors that it may use (modulo their number) while this lives;
/// does nothing where the system does not offer it.
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
