#include "wear.hpp"

#include <algorithm>
#include <cstdio>

#include <bodice/tryon/penetration.hpp>

namespace bench {
namespace {

using namespace bodice;
using geometry::Vec3;

constexpr double kFrame_s = 1.0 / 60.0;
constexpr int kFirstFrames = 10;  // a garment that starts inside may take them to come out

double mean_height(const std::vector<Vec3>& positions) {
  double sum = 0.0;
  for (const Vec3& p : positions) sum += p.y();
  return sum / static_cast<double>(positions.size());
}

void trace(int frame, const cloth::FrameReport& r, double deepest_m) {
  std::printf(
      "  %4d  %6.2f mm deep  stretch %5.2f %5.1f %%  %7.2f mm/s  asleep %5zu  %8.4f J kinetic %8.4f J "
      "elastic  contacts %llu fallbacks %llu limits %x\n",
      frame, 1e3 * deepest_m, 1e2 * r.stretch_p95, 1e2 * r.stretch_max, 1e3 * r.median_speed_m_s, r.asleep,
      r.kinetic_energy_j, r.elastic_energy_j, static_cast<unsigned long long>(r.contacts.contacts),
      static_cast<unsigned long long>(r.contacts.fallbacks), r.limits);
}

}  // namespace

Wear wear(const engine::Context& context, const Body& body, const tryon::WornGarment& garment,
          const WearOptions& options) {
  const tryon::Wardrobe all = tryon::join({garment});
  cloth::SolverOptions settings = options.solver;
  settings.thickness_m =
      tryon::fitted_thickness_m(context, all.mesh, *body.skin.distance, body.proxy.stature_m());
  auto made = cloth::Solver::make(all.mesh, all.held, options.fabric, settings);
  Wear out;
  out.finite = made.ok();
  if (!made) return out;
  cloth::Solver& solver = *made;
  const collision::Collider collider(body.proxy);
  solver.move_pins(tryon::held_positions(all, collider, settings.thickness_m));

  out.particles = solver.particles(), out.held = all.held.size();
  std::vector<Vec3> positions(all.mesh.positions.size());
  solver.positions(positions);
  const double start = mean_height(positions);
  std::vector<double> ms;
  for (int frame = 1; frame <= options.windy_frames + options.calm_frames; ++frame) {
    if (frame == options.windy_frames + 1) {
      cloth::Environment calm = settings.environment;
      calm.wind_m_s = Vec3::Zero();
      out.finite = out.finite && solver.set_environment(calm).ok();
    }
    const std::int64_t begin_ns = context.clock->now_ns();
    const cloth::FrameReport report = solver.step(context, collider, kFrame_s);
    ms.push_back(static_cast<double>(context.clock->now_ns() - begin_ns) * 1e-6);
    solver.positions(positions);
    const double deepest = tryon::penetration(context, *body.skin.distance, positions).deepest_m;
    if (frame > kFirstFrames) out.settled_deepest_m = std::max(out.settled_deepest_m, deepest);
    out.end_deepest_m = deepest;
    out.finite = out.finite && report.finite;
    out.rest_speed_m_s = report.median_speed_m_s;
    out.asleep = report.asleep;
    if (options.trace && frame % 30 == 0) trace(frame, report, deepest);
    if (frame != options.windy_frames) continue;
    out.stretch_p95 = report.stretch_p95, out.stretch_max = report.stretch_max;
    out.windy_speed_m_s = report.median_speed_m_s;
    out.end = positions;
  }
  out.drop_m = start - mean_height(positions);
  out.pierced_share = tryon::pierced_share(context, *body.skin.distance, positions, all.mesh.triangles);
  std::ranges::sort(ms);
  auto at = [&](double q) { return ms[static_cast<std::size_t>(q * static_cast<double>(ms.size() - 1))]; };
  out.frame_ms_median = at(0.5), out.frame_ms_p99 = at(0.99), out.frame_ms_max = ms.back();
  return out;
}

}  // namespace bench
