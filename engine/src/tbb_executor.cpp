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

namespace bodice::engine {
namespace {

// TBB takes the least of all limits in force; one number for all executors keeps them out of each other's
// way. It caps threads, and makes none.
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
    const Place place = find_place();
    if (count <= 1 || concurrency_ == 1) {
      loop.work();
    } else if (place == Place::kBulk) {
      // Tasks of a nested bulk carry the isolation of the outermost one, so that its waiting threads can
      // take them; a fresh isolation for each nesting would leave those threads idle.
      arena_.execute([&] { spread(loop, count); });
    } else if (place == Place::kArena || attached_) {
      spread_isolated(loop, count);
    } else if (!entered_.exchange(true, std::memory_order_acquire)) {
      const Leaving leaving(entered_);
      spread_isolated(loop, count);
    } else {
      // The arena keeps one slot for a thread from outside. TBB would have a second one wait and run
      // whatever is there meanwhile, for as long as that takes; it does better alone.
      loop.work();
    }
    loop.rethrow();
  }

  bool start(std::shared_ptr<BackgroundTask> task) override {
    // Alone in its arena, the caller would have to wait for a worker that the user did not ask for.
    if (concurrency_ == 1) return false;
    // TBB calls a const copy, yet the task must be let go before the executor counts it as over.
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
    } catch (...) {  // out of memory: the destructor must not wait for what never began
      count_started(-1);
      throw;
    }
    return true;
  }

 private:
  // What the calling thread is doing for this executor.
  enum class Place { kOutside, kArena, kBulk };

  struct Leaving {
    explicit Leaving(std::atomic<bool>& flag) : entered(flag) {}
    ~Leaving() { entered.store(false, std::memory_order_release); }
    Leaving(const Leaving&) = delete;
    Leaving& operator=(const Leaving&) = delete;
    std::atomic<bool>& entered;
  };

  // A slot of the arena belongs to one thread at a time; atomic because TBB hands it over in its own way,
  // and because a thread of another arena may look at a slot that is not its own.
  struct alignas(64) Slot {
    std::atomic<std::thread::id> owner{};
    std::atomic<int> bulks{0};  // how deep the owner is in them
  };

  // Only the owner writes to its slot, so that plain loads and stores do.
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

  // In the slot's own arena: the calling thread's. The last one is for indices beyond the arena's size.
  Slot& slot() {
    const std::size_t last = slots_.size() - 1;
    const int index = tbb::this_task_arena::current_thread_index();
    return slots_[index < 0 ? last : std::min(static_cast<std::size_t>(index), last)];
  }

  Place find_place() {
    const Slot& here = slot();
    if (here.owner.load(std::memory_order_relaxed) != std::this_thread::get_id()) return Place::kOutside;
    return here.bulks.load(std::memory_order_relaxed) > 0 ? Place::kBulk : Place::kArena;
  }

  void spread_isolated(IndexLoop& loop, std::size_t count) {
    arena_.execute([&] { tbb::this_task_arena::isolate([&] { spread(loop, count); }); });
  }

  // One TBB task a worker, not one an index: drawing an index from the loop costs far less than a task.
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
  std::atomic<bool> entered_{false};  // by a thread from outside
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
