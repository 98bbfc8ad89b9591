#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <bodice/engine/executor.hpp>
#include "index_loop.hpp"

namespace bodice::inline v0_1::engine {
namespace {

// TBB takes the least of all limits in force. Executors therefore share one number, so that none lowers
// another's limit. It caps threads and makes none.
constexpr int kProcessLimit = 256;

class TbbExecutor final : public Executor {
 public:
  explicit TbbExecutor(int concurrency) : arena_(concurrency) {
    if (concurrency > tbb::info::default_concurrency()) {
      more_workers_.emplace(tbb::global_control::max_allowed_parallelism,
                            std::max(concurrency, kProcessLimit));
    }
    arena_.initialize();
    prepare();
  }
  explicit TbbExecutor(tbb::task_arena::attach attach) : arena_(attach), attached_(true) { prepare(); }

  ~TbbExecutor() override {
    std::unique_lock lock(started_mutex_);
    all_ended_.wait(lock, [this] { return started_ == 0; });
  }

  int concurrency() const noexcept override { return concurrency_; }

  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    IndexLoop loop(count, body);
    const Position position = find_position();
    if (count <= 1 || concurrency_ == 1) {
      loop.work();
    } else if (position == Position::kBulk) {
      // Tasks of a nested bulk have the isolation of the outermost one, so that its waiting threads can take
      // them. A new isolation for each nesting would leave those threads idle.
      arena_.execute([&] { spread(loop, count); });
    } else if (position == Position::kArena || attached_) {
      spread_isolated(loop, count);
    } else if (!entered_.exchange(true, std::memory_order_acquire)) {
      const Leaving leaving(entered_);
      spread_isolated(loop, count);
    } else {
      // The arena keeps one slot for a thread from outside. TBB would let a second one wait and run any other
      // work meanwhile, for as long as that takes. It is faster alone.
      loop.work();
    }
    loop.rethrow();
  }

  bool start(std::shared_ptr<BackgroundTask> task) override {
    // An arena of one has no worker; TBB would need one that the user did not request.
    if (concurrency_ == 1) return false;
    // TBB calls a const copy, but the task must be released before the executor counts it as over.
    auto run = [this, held = std::make_shared<std::shared_ptr<BackgroundTask>>(std::move(task))] {
      {
        const Visit visit(slot(), 0);
        (*held)->run();
      }
      held->reset();
      count_started(-1);
    };
    count_started(1);
    try {
      arena_.enqueue(std::move(run));
    } catch (...) {  // out of memory: the destructor must not wait for a task that never began
      count_started(-1);
      throw;
    }
    return true;
  }

 private:
  // Where the calling thread is, as seen from this executor.
  enum class Position { kOutside, kArena, kBulk };

  struct Leaving {
    explicit Leaving(std::atomic<bool>& flag) : entered(flag) {}
    ~Leaving() { entered.store(false, std::memory_order_release); }
    Leaving(const Leaving&) = delete;
    Leaving& operator=(const Leaving&) = delete;
    std::atomic<bool>& entered;
  };

  // A slot of the arena belongs to one thread at a time. Its members are atomic, because TBB passes slots on
  // without a fence that this code could use, and because a thread of another arena may read a slot that is
  // not its own.
  struct alignas(64) Slot {
    std::atomic<std::thread::id> owner{};
    std::atomic<int> bulks{0};  // how many nested bulks the owner is in
  };

  // Only the owner writes to its slot, so that relaxed loads and stores suffice.
  class Visit {
   public:
    Visit(Slot& slot, int bulks)
        : slot_(slot),
          owner_before_(slot.owner.load(std::memory_order_relaxed)),
          bulks_before_(slot.bulks.load(std::memory_order_relaxed)) {
      slot_.owner.store(std::this_thread::get_id(), std::memory_order_relaxed);
      slot_.bulks.store(bulks_before_ + bulks, std::memory_order_relaxed);
    }
    ~Visit() {
      slot_.bulks.store(bulks_before_, std::memory_order_relaxed);
      slot_.owner.store(owner_before_, std::memory_order_relaxed);
    }

   private:
    Slot& slot_;
    std::thread::id owner_before_;
    int bulks_before_;
  };

  void count_started(int by) {
    const std::lock_guard lock(started_mutex_);
    started_ += by;
    if (started_ == 0) all_ended_.notify_all();
  }

  void prepare() {
    concurrency_ = arena_.max_concurrency();
    slots_ = std::vector<Slot>(static_cast<std::size_t>(concurrency_) + 1);
  }

  // The calling thread's slot, inside this arena. The last slot is for indices beyond the arena's size.
  Slot& slot() {
    const std::size_t last = slots_.size() - 1;
    const int index = tbb::this_task_arena::current_thread_index();
    return slots_[index < 0 ? last : std::min(static_cast<std::size_t>(index), last)];
  }

  Position find_position() {
    const Slot& here = slot();
    if (here.owner.load(std::memory_order_relaxed) != std::this_thread::get_id()) return Position::kOutside;
    return here.bulks.load(std::memory_order_relaxed) > 0 ? Position::kBulk : Position::kArena;
  }

  void spread_isolated(IndexLoop& loop, std::size_t count) {
    arena_.execute([&] { tbb::this_task_arena::isolate([&] { spread(loop, count); }); });
  }

  // There is one TBB task a worker and not one an index, since drawing an index costs far less than a task.
  void spread(IndexLoop& loop, std::size_t count) {
    const int tasks = static_cast<int>(std::min(count, static_cast<std::size_t>(concurrency_)));
    tbb::parallel_for(
        tbb::blocked_range<int>(0, tasks, 1),
        [&](const tbb::blocked_range<int>&) {
          const Visit visit(slot(), 1);
          loop.work();
        },
        tbb::simple_partitioner{});
  }

  std::optional<tbb::global_control> more_workers_;
  tbb::task_arena arena_;
  const bool attached_ = false;
  int concurrency_ = 1;
  std::vector<Slot> slots_;
  std::atomic<bool> entered_{false};  // whether a thread from outside is in the arena
  std::mutex started_mutex_;
  std::condition_variable all_ended_;
  int started_ = 0;
};

}  // namespace

std::unique_ptr<Executor> make_tbb_executor(int concurrency) {
  return std::make_unique<TbbExecutor>(concurrency > 0 ? concurrency : tbb::info::default_concurrency());
}

std::unique_ptr<Executor> make_attached_tbb_executor() {
  return std::make_unique<TbbExecutor>(tbb::task_arena::attach{});
}

}  // namespace bodice::engine
