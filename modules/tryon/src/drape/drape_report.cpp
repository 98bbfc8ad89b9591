#include "drape/drape_report.hpp"

#include <algorithm>
#include <utility>

namespace bodice::inline v0_1::tryon {

DrapeReport describe(const std::vector<WornGarment>& garments, const DrapeOptions& options,
                     const cloth::SolverOptions& solver, const cloth::Fabric& fabric) {
  DrapeReport report;
  report.frames = options.frames;
  report.dt_s = options.dt_s;
  report.thickness_m = solver.thickness_m;
  report.substeps = solver.substeps;
  report.fabric = fabric.name;
  for (const WornGarment& garment : garments)
    report.garments.push_back({garment.name, garment.mesh.positions.size(), garment.held.size()});
  return report;
}

FitScale fit_scale(FitMap map, const cloth::Fabric& fabric) {
  constexpr double kLoose_m = 0.05, kLeastStrain = 0.02;
  if (map == FitMap::kEase) return {map, kLoose_m, 0.0};
  return {map, 0.0, std::max(kLeastStrain, 2.0 * fabric.max_stretch)};
}

void add_frame(int frame, const Penetration& depth, DrapeReport& report) {
  if (depth.deepest_m > report.penetration_max_m) {
    report.penetration_max_m = depth.deepest_m;
    report.worst_frame = frame;
  }
  report.penetration_of_frame_m.push_back(depth.deepest_m);
  report.penetration_over_1mm = depth.over_1mm;
  report.penetration_end_m = depth.deepest_m;
}

void add_cloth(const cloth::FrameReport& last, DrapeReport& report) {
  report.stretch_p95 = last.stretch_p95;
  report.stretch_max = last.stretch_max;
  report.median_speed_m_s = last.median_speed_m_s;
}

void summarize_times(std::vector<double> frame_ms, DrapeReport& report) {
  if (frame_ms.empty()) return;
  std::ranges::sort(frame_ms);
  auto at = [&](double q) {
    return frame_ms[static_cast<std::size_t>(q * static_cast<double>(frame_ms.size() - 1))];
  };
  report.frame_ms_median = at(0.5);
  report.frame_ms_p99 = at(0.99);
  report.frame_ms_max = frame_ms.back();
}

}  // namespace bodice::tryon
