#include <bodice/engine/executor.hpp>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace bodice::engine {
namespace {

class InlineExecutor final : public Executor {
 public:
  int concurrency() const noexcept override { return 1; }
  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    for (std::size_t i = 0; i < count; ++i) body(i);
  }
};

class TbbExecutor final : public Executor {
 public:
  explicit TbbExecutor(int concurrency) : arena_(concurrency > 0 ? concurrency : tbb::task_arena::automatic) {
    arena_.initialize();
  }
  int concurrency() const noexcept override { return arena_.max_concurrency(); }
  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, count, 1),
          [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
          },
          tbb::simple_partitioner{});
    });
  }

 private:
  tbb::task_arena arena_;
};

}  // namespace

Executor& inline_executor() noexcept {
  // Stateless, so sharing it shares nothing.
  static InlineExecutor executor;
  return executor;
}

std::unique_ptr<Executor> make_tbb_executor(int concurrency) {
  return std::make_unique<TbbExecutor>(concurrency);
}

}  // namespace bodice::engine
