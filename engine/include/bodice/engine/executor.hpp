// Where tasks run. Nothing in bodice starts a thread except the executor that the caller made.
#pragma once

#include <cstddef>
#include <memory>

#include <bodice/engine/function_ref.hpp>

namespace bodice::engine {

/// Runs bodies of work. Thread-safe; `bulk` may be called from inside `bulk`.
class Executor {
 public:
  virtual ~Executor() = default;

  /// Upper bound on bodies that run at the same time; 1 for the inline executor.
  virtual int concurrency() const noexcept = 0;

  /// Calls body(i) once for each i in [0, count), in any order and on any worker, and returns when all
  /// have ended. The first exception is rethrown after the running bodies ended. Cost: one task a body.
  virtual void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) = 0;
};

/// Serial: runs everything on the calling thread, in order.
Executor& inline_executor() noexcept;

/// Own TBB arena with the given number of workers, the caller included; 0 means one a hardware thread.
std::unique_ptr<Executor> make_tbb_executor(int concurrency = 0);

}  // namespace bodice::engine
