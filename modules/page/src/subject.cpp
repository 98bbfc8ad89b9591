#include <bodice/page/page.hpp>

#include <algorithm>
#include <functional>
#include <thread>

#include <bodice/engine/text.hpp>

namespace bodice::page {
namespace {

DrapeCurves curves_of(const tryon::DrapeReport& drape) {
  DrapeCurves curves;
  for (const double depth_m : drape.penetration_of_frame_m) curves.penetration_mm.push_back(1e3 * depth_m);
  for (const tryon::KeptFrame& f : drape.kept)
    curves.kept.push_back({f.time_s, 1e3 * f.proxy_error.error_m.mean, 1e3 * f.penetration_max_m});
  curves.worst_frame = drape.worst_frame;
  curves.dt_s = drape.dt_s;
  return curves;
}

}  // namespace

namespace {

/// The longest spans of a trace, in order of their begin.
std::vector<TaskSpan> tasks_of(const engine::Trace& trace) {
  constexpr std::size_t kMost = 200;
  std::vector<engine::TraceEvent> events = trace.events();
  if (events.empty()) return {};
  const std::int64_t first_ns = events.front().begin_ns;
  std::vector<std::thread::id> threads;
  std::vector<TaskSpan> tasks;
  for (const engine::TraceEvent& event : events) {
    auto thread = std::ranges::find(threads, event.thread);
    if (thread == threads.end()) thread = threads.insert(thread, event.thread);
    tasks.push_back({event.name, 1e-6 * static_cast<double>(event.begin_ns - first_ns),
                     1e-6 * static_cast<double>(event.end_ns - event.begin_ns),
                     static_cast<int>(thread - threads.begin())});
  }
  if (tasks.size() > kMost) {
    std::ranges::stable_sort(tasks, std::ranges::greater{}, &TaskSpan::ms);
    tasks.resize(kMost);
    std::ranges::stable_sort(tasks, {}, &TaskSpan::begin_ms);
  }
  return tasks;
}

}  // namespace

PageSubject subject_of(const tryon::PreparedBody& body, const PageContent& content) {
  PageSubject subject;
  subject.title =
      body.skin.input.file.empty() ? "the built-in body" : body.skin.input.file.filename().string();
  subject.tier = proxy::name(body.fit.proxy.tier());
  subject.hash = engine::hex64(body.fit.proxy.hash());
  subject.scene = content.scene;
  subject.gap_mean_mm = 1e3 * body.fit.accuracy.gap_m.mean;
  subject.gap_p95_mm = 1e3 * body.fit.accuracy.gap_m.p95;
  for (const body::Landmark& l : body.skin.anatomy.landmarks)
    if (l.confidence > 0.0) subject.landmarks.push_back({std::string(body::name(l.id)), l.position});
  subject.warnings = body.all_warnings();
  subject.stages = body.all_stages();
  if (content.drape) {
    const tryon::DrapeReport& drape = *content.drape;
    subject.drape = curves_of(drape);
    subject.warnings.insert(subject.warnings.end(), drape.warnings.begin(), drape.warnings.end());
    subject.stages.insert(subject.stages.end(), drape.stages.begin(), drape.stages.end());
  }
  subject.report = content.report;
  if (content.trace) subject.tasks = tasks_of(*content.trace);
  return subject;
}

}  // namespace bodice::page
