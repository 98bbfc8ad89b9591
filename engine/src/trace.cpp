#include <bodice/engine/trace.hpp>

#include <algorithm>

namespace bodice::inline v0_1::engine {

// One event. A slot belongs to the thread that drew its number, until `ready` passes it to readers.
struct Trace::Slot {
  TraceEvent event;
  std::atomic<bool> ready{false};
};

Trace::Trace(std::size_t capacity) : capacity_(capacity), slots_(std::make_unique<Slot[]>(capacity)) {}
Trace::~Trace() = default;

void Trace::record(std::string_view name, std::int64_t begin_ns, std::int64_t end_ns,
                   std::int64_t value) noexcept {
  const std::size_t index = next_.fetch_add(1, std::memory_order_relaxed);
  if (index >= capacity_) return;
  TraceEvent& event = slots_[index].event;
  std::copy_n(name.data(), std::min(name.size(), TraceEvent::kMaxName), event.name);
  event.begin_ns = begin_ns;
  event.end_ns = end_ns;
  event.value = value;
  event.thread = std::this_thread::get_id();
  slots_[index].ready.store(true, std::memory_order_release);
}

std::size_t Trace::dropped() const noexcept {
  const std::size_t drawn = next_.load(std::memory_order_relaxed);
  return drawn > capacity_ ? drawn - capacity_ : 0;
}

std::vector<TraceEvent> Trace::events() const {
  const std::size_t drawn = std::min(next_.load(std::memory_order_relaxed), capacity_);
  std::vector<TraceEvent> events;
  events.reserve(drawn);
  for (std::size_t i = 0; i < drawn; ++i) {
    if (slots_[i].ready.load(std::memory_order_acquire)) events.push_back(slots_[i].event);
  }
  // If two spans begin together, the longer one is the outer one.
  std::stable_sort(events.begin(), events.end(), [](const TraceEvent& a, const TraceEvent& b) {
    return a.begin_ns != b.begin_ns ? a.begin_ns < b.begin_ns : a.end_ns > b.end_ns;
  });
  return events;
}

}  // namespace bodice::engine
