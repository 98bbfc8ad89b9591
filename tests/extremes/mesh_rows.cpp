#include <algorithm>
#include <cmath>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/cloth/solver.hpp>
#include <bodice/cloth/weld.hpp>
#include <bodice/fitting/enclose_parts.hpp>
#include <bodice/geodesic/distance_solver.hpp>
#include <bodice/geodesic/isoline.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice_test/extremes.hpp>

#include "rows.hpp"

namespace extremes {
namespace {

using namespace bodice;
using bodice_test::MeshCase;
using geometry::TriMesh;
using geometry::Vec3;

double size_of(const TriMesh& mesh) {
  return geometry::bounding_box(mesh.positions).size().norm();
}

/// The repaired mesh, or nothing if it is refused. `wrong` is set if it should not be refused, or should be.
std::optional<TriMesh> repaired(const MeshCase& c, std::string& wrong) {
  const auto found = geometry::repair({}, c.mesh);
  if (!found.ok()) {
    wrong = c.usable ? "refused: " + found.error().message : check_refusal(found);
    return {};
  }
  if (!c.usable) wrong = "accepted";
  for (const Vec3& p : found->mesh.positions)
    if (!p.allFinite()) wrong = "a vertex is not finite";
  return found->mesh;
}

std::string check_mesh_distance(const TriMesh& mesh) {
  const geometry::MeshDistance distance({}, mesh);
  const double size = size_of(mesh), far = geometry::bounding_box(mesh.positions).center().norm();
  for (std::size_t t = 0; t < std::min<std::size_t>(mesh.triangles.size(), 50); ++t) {
    const Vec3 on = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    if (std::abs(distance.signed_distance(on)) > 1e-12 * size + 1e-15 * far)
      return "a point of the mesh is off it";
    const double outside = distance.signed_distance(on + 10.0 * size * Vec3::UnitX());
    if (!(outside > 8.0 * size && outside < 12.0 * size)) return "a far point is not far, or inside";
  }
  return {};
}

std::string check_geodesics(const TriMesh& mesh, geodesic::Method method) {
  const auto edges = geometry::mesh_edges(mesh);
  const geodesic::DistanceSolver solver({}, mesh, edges, method);
  const auto field = solver.distances_from(0);
  if (field.size() != mesh.positions.size() || field[0] != 0.0f) return "no distance of 0 at the source";
  for (std::size_t v = 0; v < field.size(); ++v) {
    if (std::isnan(field[v]) || field[v] < 0.0f) return "a distance is NaN or negative";
    const double straight = (mesh.positions[v] - mesh.positions[0]).norm();
    if (static_cast<double>(field[v]) < 0.99 * straight) return "shorter than the straight line";
  }
  const std::vector<float> levels = {0.25f * static_cast<float>(size_of(mesh)), 0.0f};
  for (const auto& level : geodesic::isolines(mesh, edges, field, levels))
    for (const auto& line : level)
      if (!std::isfinite(line.girth_m) || !line.centroid.allFinite()) return "an isoline is not finite";
  return {};
}

std::string check_anatomy_of_mesh(const TriMesh& mesh) {
  const auto found = anatomy::analyze({}, mesh, {.profile = body::find_profile("ansur2").value()});
  if (!found.ok()) return check_refusal(found);
  if (!std::isfinite(found->stature_m) || found->part.size() != mesh.positions.size()) return "not finite";
  for (const auto& landmark : found->landmarks)
    if (!landmark.position.allFinite()) return "a landmark is not finite";
  return expect(!found->warnings.empty(), "no body, and no warning");  // none of these is a human body
}

fitting::LabeledSkin labeled(const TriMesh& mesh, std::vector<body::Part>& part) {
  part.assign(mesh.positions.size(), body::Part::kTorsoUL);
  const auto box = geometry::bounding_box(mesh.positions);
  for (std::size_t v = 0; v < part.size(); ++v)
    if (mesh.positions[v].y() > box.center().y()) part[v] = body::Part::kHead;
  return {mesh, part, std::max(size_of(mesh), 1e-300)};
}

std::string check_fit(const TriMesh& mesh, proxy::Tier tier) {
  std::vector<body::Part> part;
  const auto skin = labeled(mesh, part);
  const auto fit = fitting::fit({}, skin, {.tier = tier, .max_ellipsoids = 6, .time_budget_s = 0.1});
  if (!fit.ok()) return check_refusal(fit);
  const auto& a = fit->accuracy;
  if (!std::isfinite(a.gap_m.mean + a.gap_m.max + a.skin_outside_depth_m)) return "not finite";
  for (const auto& e : fit->proxy.ellipsoids())
    if (!e.shape.center.allFinite() || !(e.shape.radii.minCoeff() > 0.0)) return "a bad ellipsoid";
  if (tier != proxy::Tier::kSolid) return {};
  return expect(a.skin_outside_depth_m <= 1e-6 * skin.stature_m, "solid leaves skin outside");
}

std::string check_parts(const TriMesh& mesh) {
  std::vector<body::Part> part;
  const auto skin = labeled(mesh, part);
  const auto proxy = fitting::enclose_parts({}, skin, fitting::FitOptions{}.parts);
  if (!proxy.ok()) return check_refusal(proxy);
  double outside = 0.0;
  for (const geometry::Triangle& t : mesh.triangles)
    for (const geometry::Index v : t) {
      double least = 1e300;
      for (const auto& e : proxy->ellipsoids())
        least = std::min(least, geometry::closest_point(e.shape, mesh.positions[v]).signed_distance);
      outside = std::max(outside, least);
    }
  const double far = geometry::bounding_box(mesh.positions).center().norm();
  return expect(outside <= 1e-6 * size_of(mesh) + 1e-12 * far, "a vertex is outside");
}

std::string check_cloth(const TriMesh& mesh, double dt_s) {
  auto solver = cloth::Solver::make(mesh, {}, cloth::find_fabric("cotton").value(), {});
  if (!solver.ok()) return check_refusal(solver);
  for (int frame = 0; frame < 3; ++frame)
    if (!solver->step({}, dt_s).finite) return "not finite";
  std::vector<Vec3> at(mesh.positions.size());
  solver->positions(at);
  for (std::size_t v = 0; v < at.size(); ++v)
    if (mesh.positions[v].allFinite() && !at[v].allFinite()) return "a position is not finite";
  return {};
}

template <class Check>
void add_mesh_row(std::vector<Row>& rows, const MeshCase& c, const char* algorithm, Check check) {
  rows.push_back({algorithm, c.name, [&c, check] {
                    std::string wrong;
                    const auto mesh = repaired(c, wrong);
                    return mesh && wrong.empty() ? std::string(check(*mesh)) : wrong;
                  }});
}

}  // namespace

std::vector<Row> mesh_rows() {
  std::vector<Row> rows;
  for (const MeshCase& c : bodice_test::extreme_meshes()) {
    add_mesh_row(rows, c, "repair", [](const TriMesh&) { return ""; });
    add_mesh_row(rows, c, "MeshDistance", check_mesh_distance);
    for (const auto& [name, method] :
         {std::pair("geodesics, edges", geodesic::Method::kEdges),
          std::pair("geodesics, unfolded", geodesic::Method::kUnfolded),
          std::pair("geodesics, fast marching", geodesic::Method::kFastMarching)})
      add_mesh_row(rows, c, name, [method = method](const TriMesh& m) { return check_geodesics(m, method); });
    add_mesh_row(rows, c, "anatomy::analyze", check_anatomy_of_mesh);
    add_mesh_row(rows, c, "enclose_parts", check_parts);
    for (const auto& [name, tier] :
         {std::pair("fit, paper", proxy::Tier::kPaper), std::pair("fit, solid", proxy::Tier::kSolid),
          std::pair("fit, tight", proxy::Tier::kTight), std::pair("fit, relief", proxy::Tier::kRelief)})
      add_mesh_row(rows, c, name, [tier = tier](const TriMesh& m) { return check_fit(m, tier); });
    // Garments are not repaired here, because the solver welds them itself.
    for (const double dt_s : {0.0, 1.0 / 60.0, 1.0})
      rows.push_back({"cloth, dt " + std::to_string(dt_s) + " s", c.name,
                      [&c, dt_s] { return check_cloth(c.mesh, dt_s); }});
  }
  return rows;
}

}  // namespace extremes
