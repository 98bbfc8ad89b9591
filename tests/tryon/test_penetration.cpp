// The figures of penetration, which users rely on, are checked on a ball with known depths.

#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/tryon/penetration.hpp>
#include <bodice/tryon/wardrobe.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using geometry::Vec3;

TEST_CASE("particles inside a ball are counted at their depth") {
  const geometry::TriMesh ball = bodice_test::icosphere(1.0, 5);
  const engine::Context context;
  const geometry::MeshDistance skin(context, ball);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> positions = {{0.99, 0, 0}, {0, 0.9995, 0}, {0, 0, 1.5},
                                       {0.5, 0, 0},  {nan, 0, 0},    {0, 3, 4}};
  const tryon::Penetration found = tryon::penetration(context, skin, positions);
  CHECK(found.over_1mm == 2);
  CHECK(found.deepest_m == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("a sheet through a ball is pierced although its corners are outside") {
  const engine::Context context;
  const geometry::MeshDistance skin(context, bodice_test::icosphere(1.0, 4));
  const std::vector<Vec3> corners = {{-3, 0, -3}, {3, 0, -3}, {0, 0, 6}, {-3, 9, -3}, {3, 9, -3}, {0, 9, 6}};
  const std::vector<geometry::Triangle> triangles = {{0, 1, 2}, {3, 4, 5}};
  CHECK(tryon::penetration(context, skin, corners).over_1mm == 0);
  CHECK(tryon::pierced_share(context, skin, corners, triangles) == doctest::Approx(0.5));
}

namespace {

/// A ball of radius 0.2 m for a body of 1.7 m. With relief its surface is lifted by 5 mm in all directions.
proxy::BodyProxy ball(bool relief) {
  constexpr int kNodes = 4;
  proxy::BodyProxy::Data data{.tier = proxy::Tier::kSolid, .stature_m = 1.7};
  data.ellipsoids.push_back({{Vec3(0.1, 1.0, 0.0), geometry::Mat3::Identity(), Vec3::Constant(0.2)}});
  if (relief) {
    data.tier = proxy::Tier::kRelief;
    data.relief.push_back({.nodes_per_side = kNodes, .h_offset_m = 0.005f});
    data.texels.resize(kNodes * kNodes);
  }
  return proxy::BodyProxy::make(std::move(data)).value();
}

/// The number of particles counted of 600 spread over all directions at `depth_m` inside a sphere of this
/// radius.
std::size_t count_at(double depth_m, double radius_m, bool relief) {
  bodice::engine::Random random(5);
  std::vector<Vec3> positions;
  for (int i = 0; i < 600; ++i) {
    const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    positions.push_back(Vec3(0.1, 1.0, 0.0) + (radius_m - depth_m) * direction);
  }
  const auto executor = bodice_test::make_threads(2);
  return tryon::count_inside({.executor = executor.get()}, ball(relief), positions);
}

}  // namespace

TEST_CASE("particles deeper in a proxy than the tolerance are counted, with relief from the raised surface") {
  CHECK(count_at(1e-4, 0.2, false) == 600);
  CHECK(count_at(3e-6, 0.2, false) == 600);  // the tolerance is 1e-6 statures
  CHECK(count_at(1e-6, 0.2, false) == 0);
  CHECK(count_at(-1e-4, 0.2, false) == 0);
  CHECK(count_at(1e-4, 0.205, true) == 600);
  CHECK(count_at(6e-5, 0.205, true) == 600);  // the tolerance is 0.05 mm
  CHECK(count_at(4e-5, 0.205, true) == 0);
  CHECK(count_at(-1e-4, 0.205, true) == 0);
}

TEST_CASE("positions that are not finite are not counted as inside a proxy") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::vector<Vec3> positions = {Vec3(nan, 1.0, 0.0), Vec3(0.1, inf, 0.0), Vec3(0.1, 1.0, 0.0)};
  CHECK(tryon::count_inside({}, ball(true), positions) == 1);
  CHECK(tryon::count_inside({}, ball(false), positions) == 1);
}

TEST_CASE("the distance of cloth is half its thickness plus the proxy's error, for coarse and fine cloth") {
  const engine::Context context;
  const geometry::MeshDistance skin(context, bodice_test::icosphere(0.2, 5));
  auto thickness = [&](double radius, double gap_m, int halvings) {
    proxy::BodyProxy::Data data{.tier = proxy::Tier::kSolid, .stature_m = 1.7};
    data.ellipsoids.push_back({{Vec3::Zero(), geometry::Mat3::Identity(), Vec3::Constant(radius)}});
    const collision::Collider collider(proxy::BodyProxy::make(std::move(data)).value());
    return tryon::known_thickness_m(context, bodice_test::icosphere(0.2 + gap_m, halvings), skin, collider);
  };
  CHECK(thickness(0.2, 0.005, 4) == doctest::Approx(1e-3).epsilon(0.1));
  CHECK(thickness(0.198, 0.005, 4) == doctest::Approx(2.5e-3).epsilon(0.1));  // the skin stands out by 2 mm
  CHECK(thickness(0.198, 0.005, 1) == doctest::Approx(2.5e-3).epsilon(0.1));
  CHECK(thickness(0.198, 0.001, 4) == doctest::Approx(2.5e-3).epsilon(0.1));
  CHECK(thickness(0.17, 0.005, 4) == doctest::Approx(8e-3));
  CHECK(thickness(0.17, 0.2, 4) == doctest::Approx(1e-3));  // a wide skirt does not lie on the skin below it
}
