#include "wear.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <bodice/tryon/penetration.hpp>
#include "conditions.hpp"

namespace bench {
namespace {

using namespace bodice;
using geometry::Vec3;

/// The pose of a body that turns about the vertical through its middle.
class Turntable {
 public:
  Turntable(const proxy::BodyProxy& proxy, const Vec3& middle) : middle_(middle) {
    for (const proxy::ProxyEllipsoid& e : proxy.ellipsoids()) rest_.push_back(e.shape);
    now_ = rest_;
  }
  void turn(double by_rad, collision::Collider& collider) {
    angle_rad_ += by_rad;
    const geometry::Mat3 turned = rotation();
    for (std::size_t k = 0; k < rest_.size(); ++k) {
      now_[k].center = middle_ + turned * (rest_[k].center - middle_);
      now_[k].axes = turned * rest_[k].axes;
    }
    collider.move_to(now_, kFrame_s);
  }
  void carry(std::vector<Vec3>& rest_to_now) const { rotate(rotation(), rest_to_now); }
  void carry_back(std::vector<Vec3>& now_to_rest) const { rotate(rotation().transpose(), now_to_rest); }
  /// Mean angle about the vertical from one set of positions to the other.
  double angle_between(const std::vector<Vec3>& from, const std::vector<Vec3>& to) const {
    double sine = 0.0, cosine = 0.0;
    for (std::size_t v = 0; v < from.size(); ++v) {
      const Vec3 a = from[v] - middle_, b = to[v] - middle_;
      sine += a.z() * b.x() - a.x() * b.z();
      cosine += a.x() * b.x() + a.z() * b.z();
    }
    return std::atan2(sine, cosine);
  }

 private:
  geometry::Mat3 rotation() const { return Eigen::AngleAxisd(angle_rad_, Vec3::UnitY()).toRotationMatrix(); }
  void rotate(const geometry::Mat3& by, std::vector<Vec3>& points) const {
    for (Vec3& p : points) p = middle_ + by * (p - middle_);
  }

  Vec3 middle_;
  std::vector<geometry::Ellipsoid> rest_, now_;
  double angle_rad_ = 0.0;
};

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
  const tryon::Wardrobe all = tryon::join({garment}).value();
  cloth::SolverOptions settings = options.solver;
  collision::Collider collider(body.proxy);
  collider.cover(context, body.skin.input.skin.positions);
  settings.thickness_m = tryon::known_thickness_m(context, all.mesh, *body.skin.distance, collider);
  auto made = cloth::Solver::make(all.mesh, all.held, options.fabric, settings);
  Wear out;
  out.finite = made.ok();
  if (!made) return out;
  cloth::Solver& solver = *made;
  Turntable table(body.proxy, collider.origin());
  const std::vector<Vec3> held = tryon::held_positions(all, collider, settings.thickness_m);
  solver.move_pins(held);

  out.particles = solver.particles(), out.held = all.held.size();
  std::vector<Vec3> positions(all.mesh.positions.size());
  solver.positions(positions);
  const double start = mean_height(positions);
  const std::vector<Vec3> worn = positions;
  std::vector<double> ms;
  for (int frame = 1; frame <= options.windy_frames + options.calm_frames; ++frame) {
    if (frame == options.windy_frames + 1) {
      cloth::Environment calm = settings.environment;
      calm.wind_m_s = Vec3::Zero();
      out.finite = out.finite && solver.set_environment(calm).ok();
    }
    if (options.turn_rad_s != 0.0) {
      table.turn(options.turn_rad_s * kFrame_s, collider);
      std::vector<Vec3> pins = held;
      table.carry(pins);
      solver.move_pins(pins);
    }
    const std::int64_t begin_ns = context.clock->now_ns();
    const cloth::FrameReport report = solver.step(context, collider, kFrame_s);
    ms.push_back(static_cast<double>(context.clock->now_ns() - begin_ns) * 1e-6);
    solver.positions(positions);
    table.carry_back(positions);
    const double deepest = tryon::penetration(context, *body.skin.distance, positions).deepest_m;
    if (frame > kFirstFrames) out.settled_deepest_m = std::max(out.settled_deepest_m, deepest);
    out.end_deepest_m = deepest;
    out.finite = out.finite && report.finite;
    if (frame > options.windy_frames) out.rest_speed_m_s = report.median_speed_m_s;
    out.asleep = report.asleep;
    if (options.trace && frame % 30 == 0) trace(frame, report, deepest);
    if (frame != options.windy_frames) continue;
    out.stretch_p95 = report.stretch_p95, out.stretch_max = report.stretch_max;
    out.windy_speed_m_s = report.median_speed_m_s;
    out.end = positions;
  }
  out.behind_rad = -table.angle_between(worn, positions);
  out.drop_m = start - mean_height(positions);
  out.pierced_share = tryon::pierced_share(context, *body.skin.distance, positions, all.mesh.triangles);
  std::ranges::sort(ms);
  auto at = [&](double q) { return ms[static_cast<std::size_t>(q * static_cast<double>(ms.size() - 1))]; };
  out.frame_ms_median = at(0.5), out.frame_ms_p99 = at(0.99), out.frame_ms_max = ms.back();
  return out;
}

}  // namespace bench
