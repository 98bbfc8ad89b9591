// Based on: Google. Trace Event Format. (complete events "X")
#include "tasks.hpp"

#include <algorithm>
#include <functional>
#include <thread>

#include <bodice/engine/json.hpp>
#include <bodice/engine/text.hpp>

namespace bodice::inline v0_1::page {
namespace {

/// Returns the longest spans of a run, which a page shows, in the order of their begin. `tasks` is in that
/// order.
std::vector<TaskSpan> longest(std::vector<TaskSpan> tasks) {
  constexpr std::size_t kMost = 200;
  if (tasks.size() <= kMost) return tasks;
  std::ranges::stable_sort(tasks, std::ranges::greater{}, &TaskSpan::ms);
  tasks.resize(kMost);
  std::ranges::stable_sort(tasks, {}, &TaskSpan::begin_ms);
  return tasks;
}

/// The position of an identifier among those seen so far; a new one is added at their end.
template <class Id>
int number_of(const Id& id, std::vector<Id>& seen) {
  auto found = std::ranges::find(seen, id);
  if (found == seen.end()) found = seen.insert(found, id);
  return static_cast<int>(found - seen.begin());
}

}  // namespace

std::vector<TaskSpan> tasks_of(const engine::Trace& trace) {
  std::vector<std::thread::id> threads;
  std::vector<TaskSpan> tasks;
  const std::vector<engine::TraceEvent> events = trace.events();
  for (const engine::TraceEvent& event : events)
    tasks.push_back({event.name, 1e-6 * static_cast<double>(event.begin_ns - events.front().begin_ns),
                     1e-6 * static_cast<double>(event.end_ns - event.begin_ns),
                     number_of(event.thread, threads)});
  return longest(std::move(tasks));
}

engine::Result<std::vector<TaskSpan>> tasks_of_trace(const std::string& trace, const std::string& file) {
  const engine::Error no_trace{engine::ErrorCode::kUnreadable, file + " is no trace of a run.",
                               "Give the file that --trace wrote."};
  std::vector<TaskSpan> tasks;
  std::vector<double> threads;
  try {
    const engine::SortedJson all = engine::SortedJson::parse(trace);
    for (const engine::SortedJson& event : all.at("traceEvents")) {
      if (event.at("ph") != "X") continue;
      const auto number = [&](const char* key) { return event.at(key).get<double>(); };
      tasks.push_back({event.at("name").get<std::string>(), 1e-3 * number("ts"), 1e-3 * number("dur"),
                       number_of(number("tid"), threads)});
    }
  } catch (const engine::JsonError&) {
    return no_trace;
  }
  if (tasks.empty()) return no_trace;
  std::ranges::stable_sort(tasks, {}, &TaskSpan::begin_ms);
  const double first_ms = tasks.front().begin_ms;
  for (TaskSpan& task : tasks) task.begin_ms -= first_ms;
  return longest(std::move(tasks));
}

}  // namespace bodice::page
