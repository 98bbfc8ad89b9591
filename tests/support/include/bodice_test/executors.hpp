// Every kind of executor with its name, for tests that must pass on all of them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <bodice/engine/executor.hpp>

namespace bodice_test {

/// The order in which a test's host runs its tasks.
enum class HostOrder {
  kRandom,    ///< its own threads draw queued tasks in random order
  kInside,    ///< at once, inside enqueue
  kOnFinish,  ///< not before finish is called for the task
};

/// A host job system over std::thread behind engine::make_host_executor; joins its threads when destroyed.
std::unique_ptr<bodice::engine::Executor> make_test_host(HostOrder order, int concurrency,
                                                         std::uint64_t seed = 1, int max_in_flight = 16);

/// An executor with real threads: TBB, or under ThreadSanitizer a host in random order.
std::unique_ptr<bodice::engine::Executor> make_threads(int concurrency);

using NamedExecutor = std::pair<std::string, std::unique_ptr<bodice::engine::Executor>>;

/// Inline, TBB with 1, 2, 3 and 7 workers, attached TBB, and the hosts above. Under ThreadSanitizer those of
/// TBB are left out, since that library is not instrumented (tests/engine/README.md).
std::vector<NamedExecutor> all_executors();

}  // namespace bodice_test
