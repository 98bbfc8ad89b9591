// A run as one page to look at: no server, no network, nothing beside it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/trace.hpp>
#include <bodice/io/scene.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::page {

/// A point with a name, in meters.
struct NamedPoint {
  std::string name;
  geometry::Vec3 position = geometry::Vec3::Zero();
};

/// One kept frame of a body that moves.
struct KeptError {
  double time_s = 0.0, proxy_error_mm = 0.0, penetration_mm = 0.0;
};

/// A drape in numbers, as curves over time.
struct DrapeCurves {
  std::vector<double> penetration_mm;  ///< deepest particle of each frame; may be empty
  std::vector<KeptError> kept;         ///< of a body that moves
  int worst_frame = 0;                 ///< from 1; 0: no particle was inside the skin
  double dt_s = 0.0;
};

/// When a task ran, and on which thread.
struct TaskSpan {
  std::string name;
  double begin_ms = 0.0, ms = 0.0;  ///< begin: from the first task on
  int thread = 0;                   ///< in order of their first tasks
};

/// What a page shows. It refers to data that must outlive it; what is absent is left out of the page.
struct PageSubject {
  std::string title, tier, hash;
  /// The skin with its parts and frames, and the garments. Its proxy is what the skin is colored by the
  /// errors of, and its surface is shown where it has relief.
  const io::Scene* scene = nullptr;
  std::span<const proxy::ProxyEllipsoid> ellipsoids;  ///< where the scene has no proxy
  std::optional<double> gap_mean_mm, gap_p95_mm;      ///< of proxy and skin, as measured when it was fitted
  std::vector<NamedPoint> landmarks;
  std::vector<engine::Warning> warnings;
  std::vector<engine::StageTime> stages;
  std::vector<TaskSpan> tasks;  ///< in order of their begin
  std::optional<DrapeCurves> drape;
  std::string report;              ///< tryon::report_json(), for download
  std::vector<std::string> lacks;  ///< a sentence for each thing that the page could show and does not
};

/// What a page shows of a run beside the body.
struct PageContent {
  const io::Scene* scene = nullptr;           ///< skin, proxy, garments and frames
  const tryon::DrapeReport* drape = nullptr;  ///< null: nothing was draped
  std::string report;                         ///< tryon::report_json(), for download
  const engine::Trace* trace = nullptr;       ///< of the run; null: the page has no timeline
};

/// A run as it ends. Of its trace the 200 longest spans are shown.
PageSubject subject_of(const tryon::PreparedBody& body, const PageContent& content);

/// The numbers of a report that tryon::report_json() wrote: title, accuracy, landmarks, warnings, stages and
/// the drape's curves. Fails with kUnreadable where the text is no such report; the error names `file`.
engine::Result<PageSubject> subject_of_report(const std::string& report, const std::string& file);

/// The 200 longest spans of a trace that engine::Trace::json() wrote. Fails with kUnreadable where the text
/// is no such trace or has no span; the error names `file`.
engine::Result<std::vector<TaskSpan>> tasks_of_trace(const std::string& trace, const std::string& file);

/// The page as HTML: the skin colored by the proxy's error, parts, landmarks, ellipsoids, the relief's
/// surface, cloth over time, error and penetration, a histogram, the times of the stages and the warnings.
/// Skins of more than 60,000 vertices are thinned, and frames are left out beyond 4 MB of positions; the page
/// notes it. Cost: one query of the proxy a vertex.
std::string page_html(const engine::Context& context, const PageSubject& subject);

}  // namespace bodice::page
