#include <bodice/engine/frame_pipeline.hpp>

#include <algorithm>

#include <bodice/engine/trace.hpp>
#include "frame_gate.hpp"

namespace bodice::inline v0_1::engine {
namespace {

int clamp_workers(const Context& context, int wanted) {
  const int all = context.executor->concurrency();
  return wanted > 0 ? std::min(wanted, all) : all;
}

class InFrame {
 public:
  explicit InFrame(FrameGate& gate) : gate_(gate) { gate_.begin_frame(); }
  ~InFrame() { gate_.end_frame(); }

 private:
  FrameGate& gate_;
};

}  // namespace

struct FramePipeline::Impl {
  Impl(const Context& given, const PipelineOptions& wanted)
      : base(given),
        options(wanted),
        gate(clamp_workers(given, wanted.frame_workers), wanted.yield,
             std::clamp(wanted.background_share, 0.0, 0.9), *given.clock),
        frame_executor(*given.executor, gate),
        background_executor(*given.executor, gate) {
    options.delay_frames = std::max(1, options.delay_frames);
  }

  Context context_on(Executor& executor) const {
    Context context = base;
    context.executor = &executor;
    return context;
  }

  void start_waiting() {
    std::erase_if(waiting, [&](const std::shared_ptr<Job>& job) { return base.executor->start(job); });
  }

  Context base;
  PipelineOptions options;
  FrameGate gate;
  FrameExecutor frame_executor;
  BackgroundExecutor background_executor;
  std::uint64_t next_frame = 0;
  std::vector<StreamBase*> streams;
  std::vector<std::shared_ptr<Job>> jobs;     // jobs that may still run
  std::vector<std::shared_ptr<Job>> waiting;  // jobs that no worker has yet
};

FramePipeline::FramePipeline(const Context& context, const PipelineOptions& options)
    : impl_(std::make_unique<Impl>(context, options)) {}

FramePipeline::~FramePipeline() {
  for (const auto& job : impl_->jobs) job->cancel();
  for (const auto& job : impl_->jobs) job->wait();
}

FrameTiming FramePipeline::frame(FunctionRef<void(const Context&)> body) {
  const Context context = impl_->context_on(impl_->frame_executor);
  FrameTiming report;
  report.index = impl_->next_frame++;
  const TraceSpan span(context, "frame", static_cast<std::int64_t>(report.index));
  const std::int64_t start_ns = context.clock->now_ns();
  for (StreamBase* stream : impl_->streams) {
    report.results_taken += stream->cross_boundary(report.index, impl_->options) ? 1 : 0;
  }
  const std::int64_t boundary_ns = context.clock->now_ns();
  {
    const InFrame in_frame(impl_->gate);
    body(context);
  }
  report.boundary_ns = boundary_ns - start_ns;
  report.body_ns = context.clock->now_ns() - boundary_ns;
  if (!impl_->waiting.empty()) impl_->start_waiting();
  return report;
}

std::uint64_t FramePipeline::next_frame() const noexcept {
  return impl_->next_frame;
}
const PipelineOptions& FramePipeline::options() const noexcept {
  return impl_->options;
}

void FramePipeline::run_pending() {
  impl_->waiting.clear();
  for (const auto& job : impl_->jobs) job->run();
}

StreamBase::StreamBase(FramePipeline& pipeline) : pipeline_(pipeline) {
  pipeline_.impl_->streams.push_back(this);
}

StreamBase::~StreamBase() {
  if (job_) job_->cancel();
  std::erase(pipeline_.impl_->streams, this);
}

std::shared_ptr<Job> StreamBase::start(std::string name, Job::Work work) {
  FramePipeline::Impl& pipeline = *pipeline_.impl_;
  if (job_) job_->cancel();
  job_ = std::make_shared<Job>(std::move(name), pipeline.context_on(pipeline.background_executor),
                               std::move(work));
  due_frame_ = pipeline.next_frame + static_cast<std::uint64_t>(pipeline.options.delay_frames);
  std::erase_if(pipeline.jobs, [](const std::shared_ptr<Job>& job) { return job->done(); });
  pipeline.jobs.push_back(job_);
  pipeline.waiting.push_back(job_);
  pipeline.start_waiting();
  return job_;
}

bool StreamBase::cross_boundary(std::uint64_t frame, const PipelineOptions& options) noexcept {
  if (!job_ || job_->canceled()) return false;
  if (options.mode == PipelineMode::kLatency) {
    collect();
    const bool any = has_collected();
    while (has_collected()) take_oldest();
    return any;
  }
  if (frame != due_frame_) return false;
  due_frame_ += static_cast<std::uint64_t>(options.delay_frames);
  const bool any = wait_for_result();
  if (any) take_oldest();
  return any;
}

bool StreamBase::wait_for_result() noexcept {
  for (;;) {
    const std::uint32_t seen = job_->events();
    const bool last_look = job_->done();
    collect();
    if (has_collected() || last_look) return has_collected();
    job_->run();  // does nothing if a worker has begun it
    if (job_->events() == seen) job_->wait_for_event_after(seen);
  }
}

}  // namespace bodice::engine
