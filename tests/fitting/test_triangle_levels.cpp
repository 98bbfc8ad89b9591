#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/ellipsoid.hpp>

#include "base/interior_grid.hpp"
#include "cover/triangle_levels.hpp"
#include "shapes.hpp"

using namespace bodice;
using geometry::Ellipsoid;
using geometry::Vec3;

namespace {

Vec3 random_point(engine::Random& random, double size) {
  const double x = random.uniform(-size, size), y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

Ellipsoid random_ellipsoid(engine::Random& random, double size, const Vec3& origin) {
  const Vec3 axis = random_point(random, 1.0).normalized();
  const Vec3 radii = random_point(random, 0.4 * size).cwiseAbs().array() + 0.02 * size;
  return {origin + random_point(random, 0.5 * size),
          Eigen::AngleAxisd(random.uniform(0.0, 3.0), axis).toRotationMatrix(), radii};
}

}  // namespace

// The oracle is geometry::level, corner by corner, also far from the origin and at extreme scales.
TEST_CASE(
    "triangle levels: a batch gives the largest level of the corners, and the ellipsoid that grows least") {
  engine::Random random(41);
  for (const double size : {1e-6, 1.0, 1e6}) {
    const Vec3 origin = size == 1.0 ? Vec3(1e4, -1e4, 1e4) : Vec3(Vec3::Zero());
    fitting::TriangleBatch batch;
    std::vector<std::array<Vec3, 3>> triangles;
    for (int i = 0; i < 203; ++i) {
      const Vec3 at = origin + random_point(random, size);
      triangles.push_back(
          {at, at + random_point(random, 0.05 * size), at + random_point(random, 0.05 * size)});
      batch.add(triangles[i][0], triangles[i][1], triangles[i][2]);
    }
    fitting::TriangleHomes homes;
    homes.clear(batch.count);
    std::vector<int> holder(triangles.size(), -1);
    std::vector<double> least(triangles.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t k = 0; k < 7; ++k) {
      const Ellipsoid e = random_ellipsoid(random, size, origin);
      const fitting::LevelForm form(e);
      std::array<double, fitting::TriangleBatch::kMost> level;
      fitting::worst_levels(form, batch, level.data());
      fitting::offer_home(form, k, batch, homes);
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, b, c] = triangles[i];
        const double worst = std::max({geometry::level(e, a), geometry::level(e, b), geometry::level(e, c)});
        CHECK(level[i] == doctest::Approx(worst).epsilon(1e-9));
        if (worst <= 1.0 && holder[i] < 0) holder[i] = static_cast<int>(k);
        if (worst > 1.0)
          least[i] = std::min(least[i], (a - e.center).norm() * (1.0 - 1.0 / std::sqrt(worst)));
      }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      REQUIRE(homes.held(i) == (holder[i] >= 0));
      if (homes.held(i))
        CHECK(homes.ellipsoid[i] == static_cast<std::uint32_t>(holder[i]));
      else
        CHECK(static_cast<double>(homes.growth_m[i]) == doctest::Approx(least[i]).epsilon(1e-4));
    }
  }
}

// Chords of an ellipsoid are known in closed form; those of its mesh are a little shorter.
TEST_CASE("interior columns: the columns through an ellipsoid are its chords, and others are empty") {
  const Ellipsoid e{Vec3(0.2, 1.0, -0.1), geometry::Mat3::Identity(), Vec3(0.3, 0.5, 0.2)};
  fitting_test::Skin skin;
  fitting_test::add_ellipsoid(skin, e, body::Part::kTorsoUL);
  const auto columns = fitting::interior_columns(skin.mesh, 0.011);
  double volume = 0.0;
  int missing = 0;
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i) {
      const double u = (columns.x(i) - e.center.x()) / e.radii.x();
      const double w = (columns.z(k) - e.center.z()) / e.radii.z(), root = 1.0 - u * u - w * w;
      const auto inside = columns.at(i, k);
      REQUIRE(inside.size() <= (root > 0.0 ? 1u : 0u));
      missing += root > 0.1 && inside.empty();
      if (inside.empty()) continue;
      const double half = e.radii.y() * std::sqrt(root);
      CHECK(inside[0].first >= e.center.y() - half - 1e-9);
      CHECK(inside[0].second <= e.center.y() + half + 1e-9);
      volume += (inside[0].second - inside[0].first) * columns.spacing_m * columns.spacing_m;
    }
  CHECK(missing == 0);
  CHECK(volume == doctest::Approx(geometry::signed_volume(skin.mesh)).epsilon(0.01));
  CHECK(fitting::interior_columns({}, 0.01).inside.empty());
}
