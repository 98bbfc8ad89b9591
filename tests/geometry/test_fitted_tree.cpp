// A tree that is fitted to other positions of its mesh, against brute force and against one that is built.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include <bodice_test/shapes.hpp>

#include "brute_distance.hpp"

using namespace bodice::geometry;
using namespace bodice_test;
using bodice::engine::Context;
using bodice::engine::Random;

namespace {

/// The mesh after a turn around z by an angle that grows along z, of `turn_rad` a unit, and a move.
TriMesh twisted(TriMesh mesh, double turn_rad, const Vec3& by) {
  for (Vec3& p : mesh.positions) p = Eigen::AngleAxisd(turn_rad * p.z(), Vec3::UnitZ()) * p + by;
  return mesh;
}

}  // namespace

TEST_CASE("a tree that is fitted to moved vertices agrees with brute force") {
  const std::vector<TriMesh> meshes = {icosphere(1.0, 3), cylinder(0.3, 2.0, 24, 8, false),
                                       joined(icosphere(1.0, 2), icosphere(0.4, 2))};
  for (const TriMesh& mesh : meshes) {
    const MeshDistance at_rest(Context{}, mesh);
    for (const double turn_rad : {0.0, 0.5, 3.0}) {
      CAPTURE(turn_rad);
      const TriMesh moved = twisted(mesh, turn_rad, {5.0, -3.0, 100.0});
      check_against_brute_force(MeshDistance(Context{}, at_rest, moved), moved, 60);
    }
    const TriMesh scaled = twisted(mesh, 1e-3, Vec3::Constant(1e6));
    check_against_brute_force(MeshDistance(Context{}, at_rest, scaled), scaled, 20);
  }
}

TEST_CASE("a tree is built where other triangles have finite vertices than in the one that is fitted") {
  const TriMesh whole = icosphere(1.0, 2);
  TriMesh lacking = whole, lacking_others = whole;
  lacking.positions[3].x() = NAN, lacking_others.positions[40].y() = INFINITY;
  const auto check = [](const TriMesh& like, const TriMesh& mesh) {
    const MeshDistance fitted(Context{}, MeshDistance(Context{}, like), mesh), built(Context{}, mesh);
    CHECK(fitted.is_closed() == built.is_closed());
    Random random(31);
    for (int i = 0; i < 200; ++i) {
      const Vec3 q(random.normal(), random.normal(), random.normal());
      CHECK(fitted.signed_distance(q) == built.signed_distance(q));
    }
  };
  check(lacking, whole), check(whole, lacking), check(lacking, lacking_others);
  check({}, whole), check(whole, {}), check(joined(whole, icosphere(0.4, 1)), whole);
  check(lacking, lacking);
}

TEST_CASE("a tree is fitted to triangles that become slivers, and to slivers that become wide") {
  const TriMesh wide = icosphere(1.0, 3);
  TriMesh narrow = wide;
  for (std::size_t t = 0; t < wide.triangles.size(); t += 9)
    narrow.positions[wide.triangles[t][0]] = wide.corner(t, 1);
  const auto check = [&](const TriMesh& like, const TriMesh& mesh) {
    const MeshDistance fitted(Context{}, MeshDistance(Context{}, like), mesh), built(Context{}, mesh);
    for (const Vec3& query : queries_around(wide, 400, 41)) {
      REQUIRE(fitted.signed_distance(query) == built.signed_distance(query));
      REQUIRE(fitted.inside(query) == built.inside(query));
    }
  };
  check(wide, narrow), check(narrow, wide);
}
