// Simulation frames and preprocessing on the same workers.
//
//        submit("body A")                      submit("body B"): A is canceled
//   host   |      [frame 0][frame 1]  [frame 2] |  [frame 3]  ...
//   worker +--> A...(helps)(helps)..A publishes     (helps) B...
//                                     ^ taken at the boundary before the next frame
//
//     FramePipeline pipeline(context, {});
//     Stream<BodyProxy> proxies(pipeline);
//     auto work = [](const Context& c, Sink<BodyProxy>& out) { return fit(c, out); };
//     Ticket ticket = proxies.submit("fit", work);
//     pipeline.frame([&](const Context& c) {
//       if (const BodyProxy* proxy = proxies.current()) step(c, *proxy);
//     });
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/function_ref.hpp>
#include <bodice/engine/ticket.hpp>
#include <bodice/engine/value_stack.hpp>

namespace bodice::inline v0_1::engine {

/// How results of background work reach frames.
enum class PipelineMode {
  kLatency,        ///< each boundary takes the newest result that is ready, and never waits
  kDeterministic,  ///< the frame at which each result takes effect is fixed; a boundary waits for a late one
};

/// What a background thread does at a checkpoint while a frame runs.
enum class BackgroundYield {
  kNone,  ///< continues its own work
  kHelp,  ///< helps with the frame's open loop, then continues
  kStay,  ///< helps with every loop of the frame until the frame ends
};

/// How frames and background work share the workers.
struct PipelineOptions {
  PipelineMode mode = PipelineMode::kLatency;
  /// In deterministic mode, result k (from 0) of a job submitted before frame f takes effect at the boundary
  /// before frame f + (k + 1) delay_frames. At least 1.
  int delay_frames = 8;
  /// The number of threads that work on a frame at the same time, the calling one included; 0: all. A lower
  /// number than the executor's reserves the other threads for background work.
  int frame_workers = 0;
  BackgroundYield yield = BackgroundYield::kStay;
  /// The least share of its time that a background thread keeps for itself under kStay, where frames follow
  /// one another without a gap; within [0, 0.9]. Frames with gaps of that length lose nothing.
  double background_share = 0.25;
};

/// The times of one frame.
struct FrameTiming {
  std::uint64_t index = 0;
  std::int64_t boundary_ns = 0;  ///< time at the boundary: waiting, in deterministic mode
  std::int64_t body_ns = 0;
  int results_taken = 0;
};

class StreamBase;

/// Runs frames on the calling thread and its helpers, and background jobs on the remaining workers.
///
/// The bound on delay: a frame never waits for background work. Its loops start on the calling thread at
/// once. A worker joins after its current block of background work (at its next checkpoint), and the frame
/// waits only for workers in a block of the frame itself. Hence a frame takes at most as long as on the
/// calling thread alone plus one of its own blocks, however long background blocks are. With background
/// blocks of at most s, and gaps between frames, all workers join after s; without gaps, after s and the
/// time that background_share takes. Only in deterministic mode does the boundary wait.
/// engine/FRAMES.md states what this needs of the machine.
///
/// Frames, submissions and reads of the streams come from one thread.
class FramePipeline {
 public:
  /// Frames and jobs run on the context's executor, which outlives the pipeline. Allocates.
  FramePipeline(const Context& context, const PipelineOptions& options);
  /// Cancels the jobs and waits for them. The streams must be destroyed before.
  ~FramePipeline();
  FramePipeline(const FramePipeline&) = delete;
  FramePipeline& operator=(const FramePipeline&) = delete;

  /// Runs a frame: a boundary, at which the streams take their results, then body(context of the frame).
  /// Allocates nothing. Rethrows what the body threw. A loop nested in a loop of the frame runs on one
  /// thread.
  FrameTiming frame(FunctionRef<void(const Context&)> body);

  /// The number of the frame that frame() runs next, from 0.
  std::uint64_t next_frame() const noexcept;
  const PipelineOptions& options() const noexcept;

  /// Runs the jobs that no worker has begun, on the calling thread. With an executor without a worker to
  /// spare (inline, one worker), jobs run in this call, in Ticket::wait, or at the boundary that needs them.
  void run_pending();

 private:
  friend class StreamBase;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The part of a stream that is the same for all types.
class StreamBase {
 public:
  StreamBase(const StreamBase&) = delete;
  StreamBase& operator=(const StreamBase&) = delete;

 protected:
  explicit StreamBase(FramePipeline& pipeline);
  virtual ~StreamBase();

  /// Starts `work` as a job that replaces and cancels the stream's last one.
  std::shared_ptr<Job> start(std::string name, Job::Work work);

 private:
  friend class FramePipeline;
  /// Takes the results that the job has published since the last boundary.
  virtual void collect() noexcept = 0;
  virtual bool has_collected() const noexcept = 0;
  virtual void take_oldest() noexcept = 0;

  bool cross_boundary(std::uint64_t frame, const PipelineOptions& options) noexcept;
  bool wait_for_result() noexcept;

  FramePipeline& pipeline_;
  std::shared_ptr<Job> job_;
  std::uint64_t due_frame_ = 0;
};

/// The end of a stream that takes a job's results. One thread at a time.
template <class T>
class Sink {
 public:
  /// Offers a result, better than the ones before, for a coming frame boundary. Throws Canceled if the job
  /// was canceled or superseded; then none of its results can take effect any more.
  void publish(std::shared_ptr<const T> value) {
    job_->token().check();
    box_->offered.push(new detail::ValueNode<T>{std::move(value)});
    detail::ValueStack<T>::free_chain(box_->retired->take_all());
    job_->signal();
  }

 private:
  template <class>
  friend class Stream;
  struct Box {
    detail::ValueStack<T> offered;
    std::shared_ptr<detail::ValueStack<T>> retired;
  };
  Sink(Job* job, std::shared_ptr<Box> box) : job_(job), box_(std::move(box)) {}
  Job* job_;
  std::shared_ptr<Box> box_;
};

/// A value that jobs make and frames read, such as a body's proxy. The newest submitted job counts.
template <class T>
class Stream final : public StreamBase {
 public:
  using Work = std::function<Result<void>(const Context&, Sink<T>&)>;

  explicit Stream(FramePipeline& pipeline) : StreamBase(pipeline) {}
  /// Cancels the stream's job, which may run on to its next checkpoint.
  ~Stream() override {
    Stack::free_chain(oldest_);
    delete current_;
  }

  /// Starts background work and cancels the stream's earlier job. The executor of the work's context lets
  /// frames go first. It must not be called from inside a loop of a frame.
  Ticket submit(std::string name, Work work);

  /// The result in effect since the last boundary, or null before the first. It is valid until the next
  /// boundary.
  const T* current() const noexcept { return current_ ? current_->value.get() : nullptr; }
  std::shared_ptr<const T> share() const noexcept { return current_ ? current_->value : nullptr; }

 private:
  using Node = detail::ValueNode<T>;
  using Stack = detail::ValueStack<T>;

  void collect() noexcept override;
  bool has_collected() const noexcept override { return oldest_ != nullptr; }
  void take_oldest() noexcept override;

  std::shared_ptr<Stack> retired_ = std::make_shared<Stack>();  // freed by publishers, never in a frame
  std::shared_ptr<typename Sink<T>::Box> box_;                  // box of the current job
  Node* oldest_ = nullptr;                                      // published but not taken, oldest first
  Node* newest_ = nullptr;
  Node* current_ = nullptr;
};

template <class T>
Ticket Stream<T>::submit(std::string name, Work work) {
  Stack::free_chain(std::exchange(oldest_, nullptr));
  newest_ = nullptr;
  box_ = std::make_shared<typename Sink<T>::Box>();
  box_->retired = retired_;
  return Ticket(
      start(std::move(name), [work = std::move(work), box = box_](Job& job, const Context& context) {
        Sink<T> sink(&job, box);
        return work(context, sink);
      }));
}

template <class T>
void Stream<T>::collect() noexcept {
  Node* newest = box_->offered.take_all();
  Node* oldest = nullptr;
  Node* const last = newest;
  while (newest) {  // the stack gives the newest first, so it is reversed
    Node* const next = std::exchange(newest->next, oldest);
    oldest = std::exchange(newest, next);
  }
  if (!oldest) return;
  (oldest_ ? newest_->next : oldest_) = oldest;
  newest_ = last;
}

template <class T>
void Stream<T>::take_oldest() noexcept {
  if (current_) retired_->push(current_);
  current_ = std::exchange(oldest_, oldest_->next);
}

}  // namespace bodice::engine
