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
