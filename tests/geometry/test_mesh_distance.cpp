// The tree against brute force over all triangles, and against closed forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice_test/data.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/read_mesh.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice::geometry;
using namespace bodice_test;
using bodice::engine::Context;
using bodice::engine::Random;

namespace {

/// The distance to a segment, and to a triangle as the least over its plane and its three segments. It is
/// slow, in long double, and does not share the library's case distinction.
using Long3 = Eigen::Matrix<long double, 3, 1>;

long double segment_distance(const Long3& a, const Long3& b, const Long3& p) {
  const Long3 d = b - a;
  const long double length2 = d.squaredNorm();
  const long double t = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0L, 1.0L) : 0.0L;
  return (a + t * d - p).norm();
}

long double triangle_distance(const Long3& a, const Long3& b, const Long3& c, const Long3& p) {
  long double best =
      std::min({segment_distance(a, b, p), segment_distance(b, c, p), segment_distance(c, a, p)});
  const Long3 n = (b - a).cross(c - a);
  if (!(n.squaredNorm() > 0)) return best;
  const Long3 projection = p - n * (n.dot(p - a) / n.squaredNorm());
  const bool inside = (b - a).cross(projection - a).dot(n) >= 0 &&
                      (c - b).cross(projection - b).dot(n) >= 0 && (a - c).cross(projection - c).dot(n) >= 0;
  return inside ? std::min(best, (projection - p).norm()) : best;
}

double brute_distance(const TriMesh& mesh, const Vec3& query) {
  long double best = INFINITY;
  auto wide = [](const Vec3& v) { return Long3(v.cast<long double>()); };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    best = std::min(best, triangle_distance(wide(mesh.corner(t, 0)), wide(mesh.corner(t, 1)),
                                            wide(mesh.corner(t, 2)), wide(query)));
  return static_cast<double>(best);
}

/// The sum of all solid angles by L'Huilier's theorem, with the sign of the volume. The library uses another
/// formula.
double brute_winding(const TriMesh& mesh, const Vec3& query) {
  long double total = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Long3 u[3];
    for (int k = 0; k < 3; ++k) u[k] = (mesh.corner(t, k) - query).cast<long double>().stableNormalized();
    long double side[3];
    for (int k = 0; k < 3; ++k) side[k] = 2 * std::asin(std::min((u[k] - u[(k + 1) % 3]).norm() / 2, 1.0L));
    const long double s = (side[0] + side[1] + side[2]) / 2;
    const long double product = std::tan(s / 2) * std::tan((s - side[0]) / 2) * std::tan((s - side[1]) / 2) *
                                std::tan((s - side[2]) / 2);
    const long double excess = 4 * std::atan(std::sqrt(std::max(product, 0.0L)));
    total += u[0].dot(u[1].cross(u[2])) < 0 ? -excess : excess;
  }
  return static_cast<double>(total / (4 * std::numbers::pi_v<long double>));
}

/// Points near the surface on both sides, in the box, and outside it.
std::vector<Vec3> queries_around(const TriMesh& mesh, int count, std::uint64_t seed) {
  Random random(seed);
  Box box;
  for (const Triangle& t : mesh.triangles)
    for (Index v : t) box.extend(mesh.positions[v]);
  const double size = box.size().norm();
  std::vector<Vec3> queries;
  for (int i = 0; i < count; ++i) {
    const std::size_t t = random.below(mesh.triangles.size());
    const Vec3 n = area_vector(mesh, t).stableNormalized();
    const double u = random.uniform();
    const double v = random.uniform() * (1.0 - u);
    const Vec3 on = mesh.corner(t, 0) + u * (mesh.corner(t, 1) - mesh.corner(t, 0)) +
                    v * (mesh.corner(t, 2) - mesh.corner(t, 0));
    const double off = size * std::pow(10.0, random.uniform(-7.0, 0.3));
    queries.push_back(on + (random.uniform() < 0.5 ? off : -off) * n);
    Vec3 anywhere;
    for (int k = 0; k < 3; ++k) anywhere[k] = box.center()[k] + 0.6 * size * random.uniform(-1.0, 1.0);
    queries.push_back(anywhere);
  }
  return queries;
}

void check_against_brute_force(const MeshDistance& distance, const TriMesh& mesh, int count) {
  const double size = bounding_box(mesh.positions).size().norm();
  const double noise = 1e-13 * (size + bounding_box(mesh.positions).center().norm());
  for (const Vec3& query : queries_around(mesh, count, 17)) {
    CAPTURE(query);
    const SurfacePoint got = distance.closest_point(query);
    const double truth = brute_distance(mesh, query);
    REQUIRE(std::abs(std::abs(got.signed_distance) - truth) <= noise + 1e-13 * truth);
    CHECK(std::abs((got.point - query).norm() - truth) <= noise + 1e-13 * truth);
    REQUIRE(got.triangle < mesh.triangles.size());
    const double winding = brute_winding(mesh, query);
    CHECK(std::abs(distance.winding_number(query) - winding) < 0.01);
    if (std::abs(winding - 0.5) > 0.02 && truth > noise) {
      CHECK((got.signed_distance < 0.0) == (winding > 0.5));
      CHECK(distance.inside(query) == (winding > 0.5));
    }
    if (std::abs(winding - 1.5) > 0.02 && truth > noise)
      CHECK(distance.winds_more_than(1.5, query) == (winding > 1.5));
    const auto within = distance.closest_point_within(query, truth * (1.0 + 1e-12) + 2.0 * noise);
    REQUIRE(within);
    CHECK(std::abs(within->signed_distance - truth) <= noise + 1e-13 * truth);
    CHECK_FALSE(distance.closest_point_within(query, truth * (1.0 - 1e-12) - 2.0 * noise));
  }
}

void check_against_brute_force(const TriMesh& mesh, int count) {
  check_against_brute_force(MeshDistance(Context{}, mesh), mesh, count);
}

/// The mesh after a turn around z by an angle that grows along z, of `turn_rad` a unit, and a move.
TriMesh twisted(TriMesh mesh, double turn_rad, const Vec3& by) {
  for (Vec3& p : mesh.positions) p = Eigen::AngleAxisd(turn_rad * p.z(), Vec3::UnitZ()) * p + by;
  return mesh;
}

}  // namespace

TEST_CASE("distance and sign agree with brute force on closed shapes") {
  check_against_brute_force(box({0.5, 1.0, 0.2}, 2), 300);
  check_against_brute_force(icosphere(1.0, 3), 150);
  check_against_brute_force(shuffled(torus(1.0, 0.3, 40, 20), 2), 100);
  check_against_brute_force(cylinder(0.3, 2.0, 24, 8), 150);
}

TEST_CASE("distance and sign agree with brute force where surfaces overlap, nest or have holes") {
  check_against_brute_force(joined(icosphere(1.0, 3), icosphere(0.8, 3, {0.7, 0.2, 0.1})), 150);
  check_against_brute_force(joined(icosphere(1.0, 2), icosphere(0.4, 2)), 150);
  TriMesh leaky = torus(1.0, 0.4, 30, 16);
  std::erase_if(leaky.triangles, [n = 0](const Triangle&) mutable { return ++n % 11 == 0; });
  check_against_brute_force(leaky, 150);
  check_against_brute_force(cylinder(0.3, 2.0, 24, 8, false), 150);
  check_against_brute_force(sheet(1.0, 2.0, 5, 7), 150);
}

TEST_CASE("the closest point among some triangles is that of a mesh of these alone") {
  const TriMesh mesh = torus(1.0, 0.3, 40, 20);
  const MeshDistance distance(Context{}, mesh);
  const auto counts = [](Index t) { return t % 7 == 3; };
  TriMesh some{.positions = mesh.positions, .triangles = {}};
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    if (counts(t)) some.triangles.push_back(mesh.triangles[t]);
  for (const Vec3& query : queries_around(mesh, 100, 29)) {
    const double truth = brute_distance(some, query);
    const auto found = distance.closest_point_within(query, 1e3, counts);
    REQUIRE(found);
    CHECK(counts(found->triangle));
    CHECK(found->signed_distance == doctest::Approx(truth).epsilon(1e-12));
    CHECK_FALSE(distance.closest_point_within(query, truth * (1.0 - 1e-9) - 1e-12, counts));
  }
  CHECK_FALSE(distance.closest_point_within(Vec3::Zero(), 1e3, [](Index) { return false; }));
}

TEST_CASE("the extremes: every usable hostile mesh after repair, and no crash before") {
  for (const MeshCase& extreme : extreme_meshes()) {
    CAPTURE(extreme.name);
    const auto repaired = repair(Context{}, extreme.mesh);
    REQUIRE(repaired.ok() == extreme.usable);
    if (extreme.usable) check_against_brute_force(repaired->mesh, 30);
  }
}

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

TEST_CASE("a mesh is closed where its border is empty") {
  const auto is_closed = [](const TriMesh& mesh) { return MeshDistance(Context{}, mesh).is_closed(); };
  CHECK(is_closed({}));
  CHECK(is_closed(icosphere(1.0, 2)));
  CHECK(is_closed(joined(torus(1.0, 0.3, 40, 20), box({0.5, 1.0, 0.2}, 2))));
  CHECK_FALSE(is_closed(sheet(1.0, 2.0, 5, 7)));
  CHECK_FALSE(is_closed(cylinder(0.3, 2.0, 24, 8, false)));
  TriMesh mesh = icosphere(1.0, 2);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  CHECK_FALSE(is_closed(mesh));
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  mesh.positions[3].x() = NAN;  // its triangles are left out
  CHECK_FALSE(is_closed(mesh));
}

TEST_CASE("an empty mesh is infinitely far") {
  const MeshDistance distance(Context{}, {});
  CHECK(distance.signed_distance(Vec3::Zero()) == INFINITY);
  CHECK(distance.closest_point(Vec3::Zero()).triangle == kNoIndex);
  CHECK_FALSE(distance.closest_point_within(Vec3::Zero(), 1e300));
  CHECK(distance.winding_number(Vec3::Zero()) == 0.0);
}

TEST_CASE("queries that are absurd get an answer, never NaN and never a crash") {
  const MeshDistance distance(Context{}, icosphere(1.0, 2));
  for (double x : extreme_values())
    for (double y : {0.0, x}) {
      CAPTURE(x);
      const SurfacePoint got = distance.closest_point({x, y, 0.0});
      CHECK_FALSE(std::isnan(got.signed_distance));
      CHECK_FALSE(std::isnan(distance.winding_number({x, y, 0.0})));
      if (std::isfinite(x) && std::abs(x) < 1e150) {
        CHECK(got.triangle != kNoIndex);
        CHECK(got.signed_distance <= std::hypot(x, y) * (1.0 + 1e-12) + 1.0);
      }
    }
}

TEST_CASE("a point on the surface is at distance zero") {
  const TriMesh mesh = icosphere(1.0, 3);
  const MeshDistance distance(Context{}, mesh);
  for (const Vec3& vertex : mesh.positions) CHECK(std::abs(distance.signed_distance(vertex)) < 1e-15);
}

TEST_CASE("real bodies: distance by brute force, sign by brute-force winding") {
  for (const char* name : {"bodies/f_avg_rest.obj", "bodies/f_avg_sit01.obj", "awkward/f_avg_holes.obj"}) {
    const auto file = data_file(name);
    if (!file) continue;
    CAPTURE(name);
    const auto repaired = repair(Context{}, read_mesh(*file));
    REQUIRE(repaired.ok());
    const MeshDistance distance(Context{}, repaired->mesh);
    int compared = 0;
    for (const Vec3& query : queries_around(repaired->mesh, 60, 23)) {
      const double got = distance.signed_distance(query);
      CHECK(std::abs(std::abs(got) - brute_distance(repaired->mesh, query)) < 1e-12);
      const double winding = brute_winding(repaired->mesh, query);
      if (std::abs(winding - 0.5) < 0.02) continue;
      ++compared;
      CHECK((got < 0.0) == (winding > 0.5));
    }
    CHECK(compared > 100);
  }
}

TEST_CASE("the tree has the same bits however many workers build it") {
  const TriMesh mesh = icosphere(1.0, 5);  // its upper nodes are built in tasks of their own
  REQUIRE(mesh.triangles.size() > 4096);
  const MeshDistance serial({}, mesh);
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    const MeshDistance built({.executor = executor.get()}, mesh);
    Random random(23);
    for (int i = 0; i < 500; ++i) {
      const Vec3 q(random.normal(), random.normal(), random.normal());
      const SurfacePoint a = serial.closest_point(q), b = built.closest_point(q);
      CHECK(a.triangle == b.triangle);
      CHECK(a.signed_distance == b.signed_distance);
      CHECK(serial.winding_number(q) == built.winding_number(q));
    }
  }
}

TEST_CASE("points a nanometer off the skin lie on its right side, which floats cannot show") {
  const TriMesh ball = bodice_test::icosphere(0.3137, 3);
  const MeshDistance distance({}, ball);
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    const Vec3 on = 0.2 * ball.corner(t, 0) + 0.5 * ball.corner(t, 1) + 0.3 * ball.corner(t, 2);
    const Vec3 out = area_vector(ball, t).normalized();
    for (const double height_m : {1e-7, 1e-8, 1e-9}) {
      CHECK(distance.inside(on - height_m * out));
      CHECK_FALSE(distance.inside(on + height_m * out));
    }
  }
}
