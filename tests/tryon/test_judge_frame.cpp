// The measures of a moving body's frames, on shapes with known distances.

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include <bodice/tryon/judge_frame.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using geometry::Vec3;

namespace {

/// Balls of one radius as a collider.
collision::Collider ball_collider(std::initializer_list<Vec3> centers, double radius_m) {
  proxy::BodyProxy::Data data;
  data.stature_m = 1.7;
  for (const Vec3& center : centers)
    data.ellipsoids.push_back({.shape = {.center = center, .radii = Vec3::Constant(radius_m)}});
  auto made = proxy::BodyProxy::make(data);
  REQUIRE(made.ok());
  return collision::Collider(*made);
}

/// Two balls of 0.2 m as one skin.
geometry::TriMesh two_balls(const Vec3& left, const Vec3& right) {
  geometry::TriMesh skin = bodice_test::icosphere(0.2, 5, left);
  const auto first = static_cast<geometry::Index>(skin.positions.size());
  const geometry::TriMesh other = bodice_test::icosphere(0.2, 5, right);
  skin.positions.insert(skin.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& t : other.triangles) skin.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return skin;
}

}  // namespace

TEST_CASE(
    "the error of a ball of a wrong radius is the difference of the radii; if too large, none is missed") {
  const geometry::TriMesh skin = bodice_test::icosphere(0.2, 5, Vec3(0.1, 1.0, 0.0));
  const geometry::MeshDistance distance({}, skin);
  const auto exact =
      tryon::measure_proxy_error({}, ball_collider({{0.1, 1.0, 0.0}}, 0.2), skin, distance, 0.03);
  CHECK(exact.error_m.max < 1e-3);  // error of the sphere's facets
  CHECK(exact.missed_share == 0.0);
  const auto large =
      tryon::measure_proxy_error({}, ball_collider({{0.1, 1.0, 0.0}}, 0.21), skin, distance, 0.03);
  CHECK(large.error_m.mean == doctest::Approx(0.01).epsilon(0.05));
  CHECK(large.missed_share == 0.0);
  CHECK(large.false_share == doctest::Approx(0.15).epsilon(0.15));  // 1 to 10 mm of the 60 that samples cover
  const auto small =
      tryon::measure_proxy_error({}, ball_collider({{0.1, 1.0, 0.0}}, 0.19), skin, distance, 0.03);
  CHECK(small.false_share == 0.0);
  CHECK(small.missed_share == doctest::Approx(0.15).epsilon(0.15));
}

TEST_CASE("the error of a proxy is weighted by area, whatever the density of the mesh") {
  const Vec3 coarse(0.0, 1.0, 0.0), fine(1.0, 1.0, 0.0);
  const geometry::TriMesh skin =
      bodice_test::joined(bodice_test::icosphere(0.2, 3, coarse), bodice_test::icosphere(0.2, 5, fine));
  const geometry::MeshDistance distance({}, skin);
  proxy::BodyProxy::Data data;
  data.stature_m = 1.7;
  for (const auto& [center, radius_m] : {std::pair(coarse, 0.2), std::pair(fine, 0.21)})
    data.ellipsoids.push_back({.shape = {.center = center, .radii = Vec3::Constant(radius_m)}});
  const collision::Collider collider(*proxy::BodyProxy::make(data));
  // The fine ball is 10 mm off. It has 16 times as many vertices as the coarse one, which is 1 mm off at
  // most.
  CHECK(tryon::measure_proxy_error({}, collider, skin, distance, 0.03).error_m.mean ==
        doctest::Approx(0.0052).epsilon(0.05));
}

TEST_CASE("skin that is buried in the body does not count") {
  const Vec3 left(0.0, 1.0, 0.0), right(0.25, 1.0, 0.0);
  const geometry::TriMesh skin = two_balls(left, right);
  const geometry::MeshDistance distance({}, skin);
  const auto exact = tryon::measure_proxy_error({}, ball_collider({left, right}, 0.2), skin, distance, 0.03);
  // The other ball covers a cap of 3/16 of each ball's area.
  CHECK(exact.samples > 3000);
  CHECK(exact.error_m.max < 1e-3);  // of the spheres' facets; the buried caps would give 30 mm
  CHECK(exact.missed_share == 0.0);
  CHECK(exact.false_share == 0.0);
}

TEST_CASE("the area of cloth inside the skin is that of the disc where a sheet cuts a ball") {
  const geometry::TriMesh skin = bodice_test::icosphere(0.2, 5);
  const geometry::MeshDistance distance({}, skin);
  const std::vector<Vec3> corners = {
      {-0.3, -0.3, 0.19}, {0.3, -0.3, 0.19}, {0.3, 0.3, 0.19}, {-0.3, 0.3, 0.19}};
  const std::vector<geometry::Triangle> sheet = {{0, 1, 2}, {0, 2, 3}};
  // Deeper than 0.5 mm: inside the ball of 0.1995 m.
  const double radius2 = 0.1995 * 0.1995 - 0.19 * 0.19;
  const tryon::ClothInside inside = tryon::cloth_inside({}, distance, corners, sheet, 0.5e-3);
  CHECK(inside.shown_m2 == doctest::Approx(3.14159265 * radius2).epsilon(0.05));
  CHECK(inside.overlapped_m2 == 0.0);
  CHECK(tryon::cloth_inside({}, distance, corners, sheet, 0.02).shown_m2 == 0.0);
}

TEST_CASE("cloth where two balls overlap is counted separately, with any number of workers") {
  const geometry::TriMesh skin = two_balls({-0.125, 0.0, 0.0}, {0.125, 0.0, 0.0});
  const geometry::MeshDistance distance({}, skin);
  const auto executor = bodice_test::make_threads(3);
  const auto cut_at = [&](double x, const engine::Context& context) {
    const std::vector<Vec3> corners = {{x, -0.3, -0.3}, {x, 0.3, -0.3}, {x, 0.3, 0.3}, {x, -0.3, 0.3}};
    const std::vector<geometry::Triangle> sheet = {{0, 1, 2}, {0, 2, 3}};
    return tryon::cloth_inside(context, distance, corners, sheet, 0.5e-3);
  };
  const tryon::ClothInside between = cut_at(0.0, {}), beside = cut_at(-0.2, {});
  CHECK(between.shown_m2 == 0.0);
  CHECK(between.overlapped_m2 ==
        doctest::Approx(3.14159265 * (0.1995 * 0.1995 - 0.125 * 0.125)).epsilon(0.05));
  CHECK(beside.overlapped_m2 == 0.0);
  CHECK(beside.shown_m2 == doctest::Approx(3.14159265 * (0.1995 * 0.1995 - 0.075 * 0.075)).epsilon(0.05));
  const tryon::ClothInside many = cut_at(-0.05, {.executor = executor.get()}), one = cut_at(-0.05, {});
  CHECK(many.shown_m2 == one.shown_m2);
  CHECK(many.overlapped_m2 == one.overlapped_m2);
}
