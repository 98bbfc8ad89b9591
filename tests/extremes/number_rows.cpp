#include <cmath>
#include <limits>

#include <bodice/cloth/solver.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/synth/garment.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/shapes.hpp>

#include "rows.hpp"

namespace extremes {
namespace {

using namespace bodice;
using geometry::Vec3;

std::string name_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

geometry::TriMesh sheet() {
  geometry::TriMesh mesh;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) mesh.positions.push_back({0.1 * i, 1.0, 0.1 * j});
  for (geometry::Index i = 0; i < 4; ++i)
    for (geometry::Index j = 0; j < 4; ++j) {
      const geometry::Index a = 5 * i + j;
      mesh.triangles.push_back({a, a + 1, a + 5});
      mesh.triangles.push_back({a + 1, a + 6, a + 5});
    }
  return mesh;
}

collision::Collider ball() {
  proxy::BodyProxy::Data data;
  data.stature_m = 1.0;
  data.ellipsoids = {{{Vec3(0.2, 0.8, 0.2), geometry::Mat3::Identity(), Vec3::Constant(0.15)}}};
  return collision::Collider(proxy::BodyProxy::make(std::move(data)).value());
}

/// Checks that absurd options are refused, or that the sheet stays finite.
std::string check_cloth(const cloth::Fabric& fabric, const cloth::SolverOptions& options, double dt_s) {
  auto solver = cloth::Solver::make(sheet(), {}, fabric, options);
  if (!solver.ok()) return check_refusal(solver);
  const collision::Collider body = ball();
  for (int frame = 0; frame < 5; ++frame)
    if (!solver->step({}, body, dt_s).finite) return "not finite";
  std::vector<Vec3> at(25);
  solver->positions(at);
  for (const Vec3& p : at)
    if (!p.allFinite()) return "a position is not finite";
  return {};
}

std::string check_fit_number(double value, void (*set)(fitting::FitOptions&, double)) {
  static const synth::Body body = synth::make_body({}, {.vertices = 1500}).value();
  fitting::FitOptions options{.tier = proxy::Tier::kPaper};
  set(options, value);
  const auto fit = fitting::fit({}, {body.mesh, body.part, body.stature_m}, options);
  if (!fit.ok())
    return std::isfinite(value) && value > 0.0 ? "refused: " + fit.error().message : check_refusal(fit);
  if (!(std::isfinite(value) && value > 0.0)) return "accepted";
  return expect(std::isfinite(fit->accuracy.gap_m.mean), "not finite");
}

std::string check_particle(float value) {
  const collision::Collider body = ball();
  float x[2] = {value, 0.0f}, y[2] = {0.0f, 0.0f}, z[2] = {0.0f, 0.0f}, v[3][2] = {};
  const collision::Particles particles{2, x, y, z, v[0], v[1], v[2]};
  collision::Contact contacts[2];
  body.query({}, particles, contacts);
  if (std::isnan(contacts[0].signed_distance)) return "a distance is NaN";
  const auto report = body.resolve({}, particles, {});
  if (report.not_finite != (std::isfinite(value) ? 0u : 1u)) return "counted wrongly";
  if (!std::isfinite(value) && x[0] == x[0] && x[0] != value) return "not left alone";
  return expect(report.unresolved == 0 && std::hypot(double{x[1]}, double{y[1]}, double{z[1]}) > 0.1499,
                "the particle beside it is not resolved");
}

}  // namespace

std::vector<Row> number_rows() {
  std::vector<Row> rows;
  const cloth::Fabric cotton = cloth::find_fabric("cotton").value();
  for (const double value : bodice_test::extreme_values()) {
    const std::string name = name_of(value);
    rows.push_back({"fit, target_error_m", name, [=] {
                      return check_fit_number(value, [](auto& o, double x) { o.target_error_m = x; });
                    }});
    rows.push_back({"fit, mu", name, [=] {
                      return check_fit_number(value,
                                              [](auto& o, double x) { o.mu_torso_m = o.mu_limbs_m = x; });
                    }});
    rows.push_back({"fit, budget_us", name,
                    [=] { return check_fit_number(value, [](auto& o, double x) { o.budget_us = x; }); }});
    rows.push_back({"cloth, dt_s", name, [=] { return check_cloth(cotton, {}, value); }});
    rows.push_back({"cloth, gravity", name, [=] {
                      return check_cloth(cotton, {.environment = {.gravity_m_s2 = {0, value, 0}}}, 1.0 / 60);
                    }});
    rows.push_back({"cloth, wind", name, [=] {
                      return check_cloth(cotton, {.environment = {.wind_m_s = {value, 0, 0}}}, 1.0 / 60);
                    }});
    rows.push_back(
        {"cloth, thickness", name, [=] { return check_cloth(cotton, {.thickness_m = value}, 1.0 / 60); }});
    rows.push_back({"cloth, density", name, [=] {
                      auto fabric = cotton;
                      fabric.density_kg_m2 = value;
                      return check_cloth(fabric, {}, 1.0 / 60);
                    }});
    rows.push_back({"cloth, stretch", name, [=] {
                      auto fabric = cotton;
                      fabric.stretch_n_m = value;
                      return check_cloth(fabric, {}, 1.0 / 60);
                    }});
    rows.push_back({"cloth, bend_friction_n", name, [=] {
                      auto fabric = cotton;
                      fabric.bend_friction_n = value;
                      return check_cloth(fabric, {}, 1.0 / 60);
                    }});
    rows.push_back({"a particle at x", name, [=] { return check_particle(static_cast<float>(value)); }});
  }
  return rows;
}

}  // namespace extremes
