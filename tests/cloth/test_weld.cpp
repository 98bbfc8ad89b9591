// Vertices of seams become one particle, damage is dropped and reported, and every input vertex has its
// particle.
#include <doctest/doctest.h>

#include <limits>

#include <bodice/cloth/weld.hpp>

#include "fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

// The same mesh with corners of its own for every triangle, like a file that has seams everywhere.
TriMesh soup(const TriMesh& mesh, double jitter_m) {
  TriMesh out;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<Index>(out.positions.size());
    for (const Index v : t) {
      const double side = out.positions.size() % 2 == 0 ? 1.0 : -1.0;
      out.positions.push_back(mesh.positions[v] + Vec3::Constant(side * jitter_m));
    }
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

}  // namespace

TEST_CASE("weld: separate triangles become the sheet again, at any scale and offset") {
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    for (const double shift : {0.0, 1e3}) {
      const TriMesh flat = sheet(7, 5, 0.7 * scale, 0.5 * scale, Vec3::Constant(shift * scale));
      const TriMesh torn = soup(flat, 1e-5 * scale);
      const auto welded = cloth::weld(torn);
      REQUIRE(welded.ok());
      CHECK(welded->mesh.positions.size() == flat.positions.size());
      CHECK(welded->mesh.triangles.size() == flat.triangles.size());
      CHECK(welded->warnings.empty());
      for (std::size_t v = 0; v < torn.positions.size(); ++v) {
        const Vec3& particle = welded->mesh.positions[welded->particle_of_vertex[v]];
        REQUIRE((particle - torn.positions[v]).norm() < 1e-4 * scale);
      }
    }
  }
}

TEST_CASE("weld: the ends of a very short edge become one particle, those of a chain of them several") {
  // The quads of the strip are 1 high and 1 wide, except for three columns of 0.06 in its middle.
  const double x[] = {0.0, 1.0, 2.0, 2.06, 2.12, 2.18, 3.18, 4.18};
  TriMesh mesh;
  for (Index i = 0; i < 8; ++i)
    mesh.positions.insert(mesh.positions.end(), {Vec3(x[i], 0, 0), Vec3(x[i], 1, 0)});
  for (Index i = 0; i < 7; ++i)
    mesh.triangles.insert(mesh.triangles.end(),
                          {{2 * i, 2 * i + 2, 2 * i + 3}, {2 * i, 2 * i + 3, 2 * i + 1}});
  const auto welded = cloth::weld(mesh);
  REQUIRE(welded.ok());
  CHECK(welded->mesh.positions.size() == 12);  // 2 and 2.06 are one particle, 2.12 and 2.18 another
  CHECK(welded->particle_of_vertex[4] == welded->particle_of_vertex[6]);
  CHECK(welded->particle_of_vertex[8] == welded->particle_of_vertex[10]);
  CHECK(welded->particle_of_vertex[6] != welded->particle_of_vertex[8]);
  for (std::size_t v = 0; v < 16; ++v)
    CHECK((welded->mesh.positions[welded->particle_of_vertex[v]] - mesh.positions[v]).norm() < 0.1);
}

TEST_CASE("weld: damaged vertices and triangles are dropped and reported, and the others stay") {
  TriMesh mesh = sheet(4, 4, 0.4, 0.4, Vec3::Zero());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.positions[12] = Vec3(nan, 0, 0);  // the middle vertex, with all its triangles
  mesh.positions.push_back(Vec3(9, 9, 9));
  mesh.triangles.push_back({0, 1, 1});
  mesh.triangles.push_back(mesh.triangles.front());
  mesh.triangles.push_back({0, 1, 4000});
  const auto welded = cloth::weld(mesh);
  REQUIRE(welded.ok());
  CHECK(welded->mesh.positions.size() == 24);
  CHECK(welded->particle_of_vertex[12] == geometry::kNoIndex);
  CHECK(welded->particle_of_vertex.back() == geometry::kNoIndex);
  REQUIRE(welded->warnings.size() == 3);
  CHECK(welded->warnings[0].code == "garment-vertices-not-finite");
  CHECK(welded->warnings[1].code == "garment-vertices-isolated");
  CHECK(welded->warnings[2].code == "garment-triangles-dropped");
}

TEST_CASE("weld: 200,000 vertices at one point become one particle in little time") {
  TriMesh mesh = sheet(4, 4, 0.4, 0.4, Vec3::Zero());
  const auto first = static_cast<geometry::Index>(mesh.positions.size());
  mesh.positions.resize(first + 200000, Vec3(0.0, 1e-9, 0.0));  // within the tolerance of a corner
  const auto welded = cloth::weld(mesh);  // comparing each with each would take a minute
  REQUIRE(welded.ok());
  CHECK(welded->mesh.positions.size() == first);
}

TEST_CASE("weld: a garment without a usable triangle fails with kUnusableGeometry") {
  TriMesh line;
  line.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  line.triangles = {{0, 1, 2}};
  for (const TriMesh& mesh : {TriMesh{}, line}) {
    const auto welded = cloth::weld(mesh);
    REQUIRE_FALSE(welded.ok());
    CHECK(welded.error().code == engine::ErrorCode::kUnusableGeometry);
  }
}

TEST_CASE("solver: set_positions() keeps the lengths at rest, and refuses a wrong number or NaN") {
  const TriMesh mesh = sheet(4, 4, 0.4, 0.4, Vec3(-0.2, 1.0, -0.2));
  bodice::cloth::Solver solver = make_solver(mesh, {}, cotton(), {});
  std::vector<Vec3> wider = mesh.positions;
  for (Vec3& p : wider) p = Vec3(1.1 * p.x(), p.y(), 1.1 * p.z());
  CHECK(solver.set_positions(wider));
  const auto farthest_m = [&] {
    double most = 0.0;
    const std::vector<Vec3> now = positions(solver, wider.size());
    for (std::size_t v = 0; v < wider.size(); ++v) most = std::max(most, (now[v] - wider[v]).norm());
    return most;
  };
  CHECK(farthest_m() < 1e-6);
  CHECK(solver.step({}, 0.0).stretch_max == doctest::Approx(0.1).epsilon(1e-3));
  CHECK(!solver.set_positions(std::span(mesh.positions).first(3)));
  std::vector<Vec3> broken = mesh.positions;
  broken[7].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK(!solver.set_positions(broken));
  CHECK(farthest_m() < 1e-6);
}
