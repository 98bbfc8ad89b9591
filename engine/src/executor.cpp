#include <bodice/engine/executor.hpp>

namespace bodice::inline v0_1::engine {
namespace {

class InlineExecutor final : public Executor {
 public:
  int concurrency() const noexcept override { return 1; }
  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    for (std::size_t i = 0; i < count; ++i) body(i);
  }
};

}  // namespace

Executor& inline_executor() noexcept {
  // The executor has no state, so that sharing it shares nothing.
  static InlineExecutor executor;
  return executor;
}

}  // namespace bodice::engine
