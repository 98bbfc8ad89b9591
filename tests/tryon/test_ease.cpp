// The ease of garments, on balls with known gaps and strains.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <bodice/tryon/ease.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using geometry::Vec3;

namespace {

/// A ball as a body: calves below, thighs above.
struct Ball {
  geometry::TriMesh skin = bodice_test::icosphere(0.2, 5);
  geometry::MeshDistance distance{{}, skin};
  std::vector<body::Part> part;

  Ball() {
    for (const Vec3& p : skin.positions)
      part.push_back(p.y() < 0.0 ? body::Part::kCalfL : body::Part::kThighL);
  }
  std::vector<tryon::PartEase> ease(const engine::Context& context, const geometry::TriMesh& rest,
                                    const std::vector<Vec3>& now) const {
    return tryon::measure_ease(context, skin, part, distance, rest, now);
  }
};

/// Sets all positions at one factor below the middle, and at another one above.
std::vector<Vec3> scaled(const geometry::TriMesh& mesh, double below, double above) {
  std::vector<Vec3> now = mesh.positions;
  for (Vec3& p : now) p *= p.y() < 0.0 ? below : above;
  return now;
}

}  // namespace

TEST_CASE("ease: the gap of a ball of cloth is the difference of the radii, for each part") {
  const Ball ball;
  const geometry::TriMesh rest = bodice_test::icosphere(0.2, 5);
  const auto ease = ball.ease({}, rest, scaled(rest, 1.02, 1.10));
  REQUIRE(ease.size() == 2);
  CHECK(ease[0].part == body::Part::kThighL);
  CHECK(ease[0].gap_median_m == doctest::Approx(0.020).epsilon(0.03));
  CHECK(ease[1].part == body::Part::kCalfL);
  CHECK(ease[1].gap_median_m == doctest::Approx(0.004).epsilon(0.05));
  CHECK(ease[1].gap_p95_m == doctest::Approx(0.004).epsilon(0.3));  // some triangles reach up to the thigh
  const double quarter_m2 = 2.0 * 3.14159265 * 0.2 * 0.2;
  CHECK(ease[0].area_m2 == doctest::Approx(1.1 * 1.1 * quarter_m2).epsilon(0.03));
}

TEST_CASE("ease: cloth that is stretched evenly has that strain everywhere") {
  const Ball ball;
  const geometry::TriMesh rest = bodice_test::icosphere(0.2, 4);
  for (const tryon::PartEase& part : ball.ease({}, rest, scaled(rest, 1.05, 1.05))) {
    CHECK(part.strain_mean == doctest::Approx(0.05).epsilon(1e-6));
    CHECK(part.strain_p95 == doctest::Approx(0.05).epsilon(1e-6));
  }
}

TEST_CASE("ease: compressed cloth has no strain, and cloth inside the skin has a negative gap") {
  const Ball ball;
  const geometry::TriMesh rest = bodice_test::icosphere(0.2, 4);
  for (const tryon::PartEase& part : ball.ease({}, rest, scaled(rest, 0.9, 0.9))) {
    CHECK(part.gap_median_m == doctest::Approx(-0.020).epsilon(0.05));
    CHECK(part.strain_p95 == 0.0);
  }
}

TEST_CASE("ease: parts without cloth and positions that are not finite are left out") {
  const Ball ball;
  geometry::TriMesh rest = bodice_test::icosphere(0.21, 4);
  std::erase_if(rest.triangles, [&](const geometry::Triangle& t) {
    return std::ranges::any_of(t, [&](geometry::Index v) { return rest.positions[v].y() > -0.01; });
  });
  std::vector<Vec3> now = rest.positions;
  now[rest.triangles[0][0]].x() = std::nan("");
  const auto ease = ball.ease({}, rest, now);
  REQUIRE(ease.size() == 1);
  CHECK(ease[0].part == body::Part::kCalfL);
  CHECK(ease[0].gap_median_m == doctest::Approx(0.01).epsilon(0.05));
  const auto threads = bodice_test::make_threads(3);
  const auto again = ball.ease({.executor = threads.get()}, rest, now);
  CHECK(again[0].gap_p95_m == ease[0].gap_p95_m);
  CHECK(ball.ease({}, {}, {}).empty());
}
