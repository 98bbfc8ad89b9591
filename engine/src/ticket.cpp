#include <bodice/engine/ticket.hpp>

#include <new>

#include <bodice/engine/trace.hpp>

namespace bodice::inline v0_1::engine {

Job::Job(std::string name, const Context& context, Work work)
    : name_(std::move(name)), context_(context), cancel_(context.cancel), work_(std::move(work)) {
  context_.cancel = cancel_.token();
}

Result<void> Job::call() noexcept {
  const TraceSpan span(context_, name_);
  try {
    context_.cancel.check();
    return work_(*this, context_);
  } catch (const Canceled&) {
    return Error{ErrorCode::kCanceled, "'" + name_ + "' was canceled.", ""};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kInternal, "No memory.", ""};  // short enough to need none
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, "'" + name_ + "' failed: " + error.what() + ".", ""};
  } catch (...) {
    return Error{ErrorCode::kInternal, "'" + name_ + "' failed with an unknown exception.", ""};
  }
}

void Job::run() noexcept {
  Stage expected = Stage::kWaiting;
  if (!stage_.compare_exchange_strong(expected, Stage::kRunning)) return;
  result_ = call();
  if (!result_ && result_.error().code != ErrorCode::kCanceled) {
    try {
      context_.warn(result_.error().sentence());
    } catch (...) {  // there is no memory for the line, or the host's log throws; the result has the error
    }
  }
  work_ = nullptr;  // releases the captures of the work here and not in a frame
  stage_.store(Stage::kDone, std::memory_order_release);
  signal();
}

void Job::wait() noexcept {
  run();
  for (std::uint32_t seen = events(); !done(); seen = events()) wait_for_event_after(seen);
}

void Job::signal() noexcept {
  events_.fetch_add(1, std::memory_order_release);
  events_.notify_all();
}

}  // namespace bodice::engine
