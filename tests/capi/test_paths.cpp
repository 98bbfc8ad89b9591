// Single points and paths of particles through the C interface.
#include "capi/scene.hpp"

using namespace capi_test;

TEST_CASE("capi: a single point has the contact of the batch, and all ellipsoids near it are found") {
  Scene scene(limb_proxy(true));
  const bodice_test::Vec3 at = scene.engine.origin() + bodice_test::Vec3(0.05, 0.06, 0.01);
  const double point[3] = {at.x(), at.y(), at.z()};
  bodice_contact one;
  REQUIRE(bodice_query_point(scene.collider.get(), point, &one) == BODICE_OK);
  const float local[3] = {float(0.05), float(0.06), float(0.01)};
  CHECK(one.distance == doctest::Approx(scene.engine.query(local).signed_distance).epsilon(1e-4));
  bodice_contact all[16];
  std::size_t found = 0;
  REQUIRE(bodice_query_all(scene.collider.get(), point, 0.05f, all, 16, &found) == BODICE_OK);
  REQUIRE(found >= 2);
  REQUIRE(found <= 16);
  for (std::size_t i = 1; i < found; ++i) CHECK(all[i - 1].distance <= all[i].distance);
}

TEST_CASE("capi: a sweep stops where the path first touches the body") {
  Scene scene(limb_proxy(false));
  bodice::engine::Random random(11);
  std::vector<double> from, to;
  for (int i = 0; i < 400; ++i) {
    for (std::vector<double>* end : {&from, &to}) {
      const bodice_test::Vec3 p = bodice_test::random_vector(random, 0.5) + scene.engine.origin();
      end->insert(end->end(), {p.x(), p.y(), p.z()});
    }
  }
  bodice::Particles particles(400);
  particles.position(to.data()).safe(from.data());
  std::vector<float> fraction(400);
  constexpr float kThickness_m = 0.003f;
  REQUIRE(bodice_sweep(scene.collider.get(), &particles, kThickness_m, scene.workspace.get(), fraction.data(),
                       nullptr) == BODICE_OK);
  // The oracle walks each path in steps of a thousandth, with the exact distance.
  const auto shapes = bodice_test::limb();
  std::size_t wrong = 0, hits = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const bodice_test::Vec3 a(from[3 * i], from[3 * i + 1], from[3 * i + 2]),
        b(to[3 * i], to[3 * i + 1], to[3 * i + 2]);
    const auto free_m = [&](double t) {
      return bodice_test::brute_force(shapes, a + t * (b - a)).signed_distance - double{kThickness_m};
    };
    const double stop = double{fraction[i]};
    hits += stop < 1.0;
    for (double t = 0.0; t < stop; t += 1e-3) wrong += free_m(t) < -1e-5;
    if (stop > 0.0 && stop < 1.0) wrong += std::abs(free_m(stop)) > 1.1e-4;
    if (stop == 0.0) wrong += free_m(0.0) > 1.1e-4;
  }
  CHECK(wrong == 0);
  CHECK(hits > 40);
}

TEST_CASE("capi: a path along the surface, just beyond the thickness, is free to its end") {
  Scene scene(limb_proxy(false));
  constexpr float kThickness_m = 0.003f;
  constexpr double kClear_m = 3e-4, kHalfPath_m = 0.25;
  const auto shapes = bodice_test::limb();
  bodice::engine::Random random(5);
  std::vector<double> from, to;
  std::vector<bool> is_free;
  while (is_free.size() < 200) {
    const bodice_test::Vec3 near = bodice_test::random_vector(random, 0.2) + scene.engine.origin();
    const auto at = bodice_test::brute_force(shapes, near);
    if (at.signed_distance < 0.0) continue;
    const bodice_test::Vec3 along = at.normal.cross(bodice_test::random_direction(random)).normalized();
    const bodice_test::Vec3 middle = at.point + (double{kThickness_m} + kClear_m) * at.normal;
    double least_m = 1.0;
    for (double t = -kHalfPath_m; t <= kHalfPath_m; t += 1e-4)
      least_m = std::min(least_m, bodice_test::brute_force(shapes, middle + t * along).signed_distance);
    is_free.push_back(least_m > double{kThickness_m} + 2e-4);
    const bodice_test::Vec3 ends[2] = {middle - kHalfPath_m * along, middle + kHalfPath_m * along};
    from.insert(from.end(), ends[0].data(), ends[0].data() + 3);
    to.insert(to.end(), ends[1].data(), ends[1].data() + 3);
  }
  bodice::Particles particles(is_free.size());
  particles.position(to.data()).safe(from.data());
  std::vector<float> fraction(is_free.size());
  REQUIRE(bodice_sweep(scene.collider.get(), &particles, kThickness_m, nullptr, fraction.data(), nullptr) ==
          BODICE_OK);
  std::size_t stopped = 0, free = 0;
  for (std::size_t i = 0; i < is_free.size(); ++i) {
    free += is_free[i];
    stopped += is_free[i] && fraction[i] < 1.0f;
  }
  CHECK(stopped == 0);
  CHECK(free > 50);
}

TEST_CASE("capi: all of three hundred ellipsoids around a point are written") {
  std::vector<bodice::geometry::Ellipsoid> shapes;
  for (int i = 0; i < 300; ++i)
    shapes.push_back({bodice_test::Vec3(0.001 * i, 0.0, 0.0), bodice::geometry::Mat3::Identity(),
                      bodice_test::Vec3::Constant(0.05)});
  Scene scene(bodice_test::proxy_of(bodice_test::data_of(shapes)));
  const double point[3] = {0.15, 0.0, 0.0};
  std::vector<bodice_contact> all(300);
  std::size_t found = 0;
  REQUIRE(bodice_query_all(scene.collider.get(), point, 1.0f, all.data(), all.size(), &found) == BODICE_OK);
  REQUIRE(found == 300);
  std::vector<bool> seen(300);
  for (const bodice_contact& contact : all) seen[contact.ellipsoid] = true;
  CHECK(std::ranges::count(seen, true) == 300);
}
