// Room between surfaces of the skin, on shapes with known gaps.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/tryon/skin_room.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr double kMost_m = 0.02;

void append(const geometry::TriMesh& more, geometry::TriMesh& all) {
  const auto first = static_cast<geometry::Index>(all.positions.size());
  all.positions.insert(all.positions.end(), more.positions.begin(), more.positions.end());
  for (const auto& t : more.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// Two balls of 0.1 m, `gap_m` apart along x, midway at the origin.
geometry::TriMesh two_balls(double gap_m) {
  constexpr double kRadius_m = 0.1;
  geometry::TriMesh skin = bodice_test::icosphere(kRadius_m, 5, Vec3(-kRadius_m - 0.5 * gap_m, 0, 0));
  append(bodice_test::icosphere(kRadius_m, 5, Vec3(kRadius_m + 0.5 * gap_m, 0, 0)), skin);
  return skin;
}

double room_m(const geometry::TriMesh& skin, const Vec3& at) {
  const geometry::MeshDistance distance({}, skin);
  return tryon::SkinRoom(skin, distance).width_m(at, kMost_m);
}

/// A strip of cloth across the z-axis, 2 cm wide, tilted about x so that two of opposite tilt cross.
geometry::TriMesh strip(double x, double tilt) {
  constexpr double kHalf_m = 0.01;
  geometry::TriMesh mesh;
  mesh.positions = {Vec3(x - kHalf_m, -kHalf_m, -tilt), Vec3(x + kHalf_m, -kHalf_m, -tilt),
                    Vec3(x, kHalf_m, tilt)};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

}  // namespace

TEST_CASE("skin room: between two balls it is their gap, also a little deeper or off the middle") {
  for (const double gap_mm : {2.0, 5.0, 9.0}) {
    CAPTURE(gap_mm);
    const geometry::TriMesh skin = two_balls(1e-3 * gap_mm);
    // Facets of the balls are up to 0.15 mm inside their spheres.
    for (const double x_mm : {0.0, 0.2 * gap_mm, -0.6 * gap_mm})
      CHECK(1e3 * room_m(skin, Vec3(1e-3 * x_mm, 0, 0)) == doctest::Approx(gap_mm).epsilon(0.1));
  }
}

TEST_CASE("skin room: without a facing surface it is the maximum, and where skin overlaps itself zero") {
  CHECK(room_m(two_balls(0.005), Vec3(-0.1025, 0.102, 0)) == kMost_m);
  CHECK(room_m(two_balls(0.1), Vec3::Zero()) == kMost_m);
  const geometry::TriMesh overlapping = two_balls(-0.01);
  CHECK(room_m(overlapping, Vec3::Zero()) == 0.0);
  CHECK(room_m(overlapping, Vec3(0.004, 0, 0)) == 0.0);
  CHECK(room_m(overlapping, Vec3(-0.1, 0.1, 0)) == kMost_m);
}

TEST_CASE("skin room: walls at right angles do not face each other") {
  const geometry::TriMesh skin = two_balls(-0.0586);  // their normals are at right angles where they meet
  CHECK(room_m(skin, Vec3(-0.004, 0.076, 0)) == kMost_m);
}

TEST_CASE("skin room: the far side of a thin limb is not a facing wall") {
  geometry::TriMesh limb = bodice_test::icosphere(1.0, 5);
  for (Vec3& p : limb.positions) p = Vec3(0.003 * p.x(), 0.1 * p.y(), 0.1 * p.z());
  CHECK(room_m(limb, Vec3(0.004, 0, 0)) == kMost_m);
}

TEST_CASE("skin room: each crossing is classified at the point where its edges pass through") {
  const geometry::TriMesh skin = two_balls(0.004);
  const geometry::MeshDistance distance({}, skin);
  geometry::TriMesh cloth = strip(0.0, 0.005);  // two pairs that cross: midway between the balls, and far off
  append(strip(0.0, -0.005), cloth);
  append(strip(0.5, 0.005), cloth);
  append(strip(0.5, -0.005), cloth);
  for (Vec3& p : cloth.positions) p.x() += 1e-4 * p.z() / 0.005;  // no edges that meet in one point
  for (const int workers : {1, 3}) {
    const auto executor = engine::make_tbb_executor(workers);
    const auto judged = tryon::judge_crossings({.executor = executor.get()}, {skin, distance},
                                               cloth.positions, cloth.triangles, 0.006);
    REQUIRE(judged.size() == 2);
    CHECK(judged[0].triangles == std::array<std::size_t, 2>{0, 1});
    CHECK_FALSE(judged[0].has_room);
    CHECK(judged[1].triangles == std::array<std::size_t, 2>{2, 3});
    CHECK(judged[1].has_room);
    CHECK(judged[1].at.x() == doctest::Approx(0.5).epsilon(0.02));
    CHECK(std::abs(judged[1].at.z()) < 1e-3);
  }
  const auto less = tryon::judge_crossings({}, {skin, distance}, cloth.positions, cloth.triangles, 0.003);
  CHECK(std::ranges::all_of(less, &tryon::JudgedCrossing::has_room));
}
