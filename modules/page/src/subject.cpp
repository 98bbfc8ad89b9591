#include <bodice/page/page.hpp>

#include <bodice/engine/text.hpp>

#include "tasks.hpp"

namespace bodice::inline v0_1::page {
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
