#include "base/context.hpp"

#include <algorithm>
#include <cstdio>
#include <new>
#include <thread>

#include "base/handles.hpp"
#include "base/structures.hpp"

namespace bodice::inline v0_1::capi {
namespace {

constexpr std::size_t kAlignment = 64;  ///< a cache line
constexpr int kMostWorkers = 1024;      ///< more is garbage

Outcome check(const bodice_context_options& options) {
  if (options.abi != BODICE_ABI)
    return {BODICE_VERSION_MISMATCH, "The program was compiled with ABI " + std::to_string(options.abi) +
                                         " of bodice.h, the library has ABI " + std::to_string(BODICE_ABI) +
                                         ". Compile the program with the header of the library."};
  if (options.workers < 0 || options.workers > kMostWorkers)
    return invalid("bodice_context_options.workers is " + std::to_string(options.workers) + ".",
                   "Give 0 for one a hardware thread, or 1 to 1024.");
  if (options.tasks_in_flight < 1 || options.tasks_in_flight > (1 << 20))
    return invalid(
        "bodice_context_options.tasks_in_flight is " + std::to_string(options.tasks_in_flight) + ".",
        "Give 1 to a million; 64 serve.");
  if (!options.enqueue != !options.finish)
    return invalid("bodice_context_options has one of enqueue and finish.", "Set both of them or neither.");
  if (!options.allocate != !options.release)
    return invalid("bodice_context_options has one of allocate and release.", "Set both of them or neither.");
  return {};
}

}  // namespace

void HostLog::write(engine::LogLevel level, std::string_view message) {
  if (static_cast<int>(level) < options_.log_level) return;
  char line[2048];
  std::snprintf(line, sizeof line, "%.*s", static_cast<int>(std::min(message.size(), sizeof line)),
                message.data());
  const std::lock_guard lock(one_at_a_time_);
  try {
    options_.log(options_.host, static_cast<std::int32_t>(level), line);
  } catch (...) {  // logging never changes what the library does
  }
}

ContextState::ContextState(const bodice_context_options& options)
    : options_(options), log_(options_), clock_(options_), memory_(options_) {}

Outcome ContextState::make(const bodice_context_options& options, SharedContext& out) {
  if (Outcome checked = check(options); !checked.ok()) return checked;
  auto state = std::make_shared<ContextState>(options);
  int workers = options.workers;
  if (workers == 0) workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (workers > 1) {
    engine::HostCallbacks callbacks{.host = options.host,
                                    .concurrency = workers,
                                    .max_tasks_in_flight = options.tasks_in_flight,
                                    .enqueue = options.enqueue,
                                    .finish = options.finish};
    if (!options.enqueue) {
      state->pool_ = std::make_unique<ThreadPool>(workers - 1, options.tasks_in_flight);
      callbacks = state->pool_->callbacks();
    }
    auto executor = engine::make_host_executor(callbacks);
    if (!executor) return executor.error();
    state->executor_ = std::move(executor).value();
  }
  out = std::move(state);
  return {};
}

engine::Context ContextState::engine_context() const {
  engine::Context context;
  if (executor_) context.executor = executor_.get();
  if (options_.log) context.log = &log_;
  if (options_.now_ns) context.clock = &clock_;
  return context;
}

void* HostMemory::allocate(std::size_t bytes, std::size_t alignment) {
  void* block = options_.allocate(options_.host, bytes, std::max(alignment, kAlignment));
  if (!block) throw std::bad_alloc();
  return block;
}

void HostMemory::release(void* block, std::size_t bytes, std::size_t) noexcept {
  options_.release(options_.host, block, bytes);
}

}  // namespace bodice::capi

bodice_status bodice_context_create(const bodice_context_options* options, bodice_context** context) {
  using namespace bodice::capi;
  return guarded([&]() -> Outcome {
    BODICE_CHECK(begin_result(context, "the context"));
    bodice_context_options known;
    BODICE_CHECK(read(options, known, true));
    SharedContext state;
    BODICE_CHECK(ContextState::make(known, state));
    *context = new bodice_context{std::move(state)};
    return {};
  });
}

void bodice_context_destroy(bodice_context* context) {
  delete context;
}
