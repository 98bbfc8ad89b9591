// Layers of cloth: what starts free of crossings stays so, and what starts crossed comes apart.
#include <doctest/doctest.h>

#include "layer_fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

// Sheets with edges of 25 mm, 4 mm above each other and each turned a little, over a ball.
LayerScene stack(int sheets) {
  LayerScene scene;
  scene.body = {ellipsoid(Vec3(0, 0, 0), Vec3::Constant(0.12))};
  for (int k = 0; k < sheets; ++k) {
    const geometry::Mat3 turned = Eigen::AngleAxisd(0.3 * k, Vec3::UnitY()).toRotationMatrix();
    append(surface(12, 12, false,
                   [&](double u, double v) {
                     return Vec3(turned * Vec3(0.3 * u - 0.15, 0.0, 0.3 * v - 0.15) +
                                 Vec3(0.0, 0.125 + 0.004 * k, 0.0));
                   }),
           scene.mesh);
  }
  return scene;
}

// A shirt with its lower half turned up over its upper half; a hip inside, and shoulders that rock it.
LayerScene half_inside_out() {
  LayerScene scene;
  scene.body = {ellipsoid(Vec3(0, 1.0, 0), Vec3(0.145, 0.5, 0.145))};
  scene.mesh = surface(36, 24, true, [](double u, double v) {
    const double down = std::min(v, 1.0 - v) * 2.0, out = v < 0.5 ? 0.0 : 0.006;
    return around(u, 0.15 + out, 1.2 - 0.3 * down);
  });
  for (Index i = 0; i < 36; ++i) scene.pins.push_back(i);
  scene.pin_at = [](const Vec3& start, double time_s) {
    const double angle = 0.5 * std::sin(9.0 * time_s);
    return Vec3(Eigen::AngleAxisd(angle, Vec3::UnitY()) * start + Vec3(0.03 * std::sin(14.0 * time_s), 0, 0));
  };
  return scene;
}

// A sleeve that is drawn between a thumb and a palm.
LayerScene through_a_hand() {
  LayerScene scene;
  scene.body = {ellipsoid(Vec3(0.037, 0.0, 0), Vec3(0.03, 0.03, 0.06)),
                ellipsoid(Vec3(-0.037, 0.0, 0), Vec3(0.03, 0.03, 0.06))};
  scene.mesh = surface(20, 24, true, [](double u, double v) {
    return around(u, 0.06 - 0.052 * std::max(0.0, 1.0 - 2.0 * v), 0.03 + 0.3 * v);
  });
  for (Index i = 0; i < 20; ++i) scene.pins.push_back(i);
  scene.pin_at = [](const Vec3& start, double time_s) { return Vec3(start - Vec3(0, 0.25 * time_s, 0)); };
  return scene;
}

// A skirt that turns, and a belt around it that slides down until the skirt is too wide.
LayerScene belt() {
  LayerScene scene;
  scene.body = {ellipsoid(Vec3(0, 1.0, 0), Vec3(0.12, 0.4, 0.12))};
  scene.mesh =
      surface(40, 16, true, [](double u, double v) { return around(u, 0.125 + 0.08 * v, 1.1 - 0.25 * v); });
  for (Index i = 0; i < 40; ++i) scene.pins.push_back(i);
  append(surface(44, 2, true, [](double u, double v) { return around(u, 0.165, 1.05 - 0.03 * v); }),
         scene.mesh);
  scene.pin_at = [](const Vec3& start, double time_s) {
    return Vec3(Eigen::AngleAxisd(std::sin(8.0 * time_s), Vec3::UnitY()) * start);
  };
  return scene;
}

// A scarf of two turns around a neck, which nods.
LayerScene scarf() {
  LayerScene scene;
  scene.body = {ellipsoid(Vec3(0, 1.0, 0), Vec3(0.06, 0.25, 0.06))};
  scene.mesh = surface(96, 6, false, [](double u, double v) {
    const double turns = 2.4 * u;
    return around(turns, 0.066 + 0.006 * turns, 1.05 - 0.1 * v);
  });
  scene.move_body = [](double time_s, std::vector<geometry::Ellipsoid>& body) {
    body.front().axes = Eigen::AngleAxisd(0.35 * std::sin(7.0 * time_s), Vec3::UnitX()).toRotationMatrix();
  };
  return scene;
}

void check_stays_free(const LayerScene& scene) {
  const LayerOutcome with = play(scene, layered(true)), without = play(scene, layered(false));
  CHECK(with.start == 0);
  CHECK(with.worst == 0);
  CHECK(with.report.layers.crossing == 0);
  CHECK(with.report.finite);
  CHECK(without.worst > 0);
}

}  // namespace

TEST_CASE("layers: a stack of sheets dropped on a ball stays free of crossings") {
  check_stays_free(stack(20));
}

TEST_CASE("layers: a shirt turned half inside out and rocked stays free of crossings") {
  check_stays_free(half_inside_out());
}

TEST_CASE("layers: a sleeve pulled through a hand stays free of crossings") {
  check_stays_free(through_a_hand());
}

TEST_CASE("layers: a belt that slides down a skirt onto its flare stays free of crossings") {
  check_stays_free(belt());
}

TEST_CASE("layers: a scarf of two turns around a neck that nods stays free of crossings") {
  check_stays_free(scarf());
}

TEST_CASE("layers: sheets thrown at each other at 10 m/s stay free of crossings") {
  LayerScene scene = stack(2);
  for (std::size_t v = 0; v < scene.mesh.positions.size() / 2; ++v)
    scene.pins.push_back(static_cast<Index>(v));
  scene.velocity = Vec3(0, -10.0, 0);
  scene.frames = 20;
  check_stays_free(scene);
}

TEST_CASE("layers: the same bits for any number of workers") {
  const LayerScene scene = scarf();
  const std::uint64_t hash = play(scene, layered(true), 1).hash;
  for (const int workers : {2, 3, 7}) CHECK(play(scene, layered(true), workers).hash == hash);
}

TEST_CASE("layers: two sheets that cross at a corner when they begin come apart, and then stay so") {
  LayerScene scene;
  scene.body = {ellipsoid(Vec3(0, -5.0, 0), Vec3::Constant(0.1))};
  append(surface(12, 12, false, [](double u, double v) { return Vec3(0.3 * u, 0.0, 0.3 * v); }), scene.mesh);
  append(
      surface(12, 12, false,
              [](double u, double v) { return Vec3(0.3 * u + 0.01, 0.02 - 0.05 * u * v, 0.3 * v + 0.01); }),
      scene.mesh);
  scene.frames = 120;
  const LayerOutcome out = play(scene, layered(true));
  CHECK(out.start > 10);
  CHECK(out.end == 0);
  CHECK(out.report.layers.crossing == 0);
}
