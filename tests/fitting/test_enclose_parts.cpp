// One enclosing ellipsoid a part: the union holds the whole skin.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/engine/executor.hpp>
#include <bodice/fitting/enclose_parts.hpp>
#include <bodice_test/executors.hpp>

#include "shapes.hpp"

using namespace bodice;
using body::Part;
using fitting_test::Skin;
using fitting_test::three_ellipsoids;
using geometry::Vec3;

namespace {

const std::uint32_t kAll = fitting::FitOptions{}.parts;

constexpr std::uint32_t bit(Part part) {
  return 1u << static_cast<unsigned>(part);
}

/// A closed ellipsoid: its lower half is thigh, its upper half is torso, and triangles at the border have
/// both.
Skin two_parts_of_one() {
  Skin skin;
  fitting_test::add_ellipsoid(skin, {Vec3(0, 0.5, 0), geometry::Mat3::Identity(), Vec3(0.1, 0.5, 0.1)},
                              Part::kThighL);
  for (std::size_t v = 0; v < skin.part.size(); ++v)
    if (skin.mesh.positions[v].y() > 0.5) skin.part[v] = Part::kTorsoLL;
  return skin;
}

/// Whether one of the ellipsoids holds all three corners, and so the whole triangle.
bool held(const proxy::BodyProxy& proxy, const Skin& skin, std::size_t t) {
  return std::ranges::any_of(proxy.ellipsoids(), [&](const auto& e) {
    for (std::size_t c = 0; c < 3; ++c)
      if (geometry::level(e.shape, skin.mesh.corner(t, c)) > 1.0 + 1e-9) return false;
    return true;
  });
}

}  // namespace

TEST_CASE("enclose parts: every triangle, also one across a border, is inside one ellipsoid") {
  for (const Skin& skin : {three_ellipsoids(), three_ellipsoids(1e-3), three_ellipsoids(1e3),
                           three_ellipsoids(1.0, Vec3(1e4, 0, -1e4)), two_parts_of_one()}) {
    CAPTURE(skin.stature_m);
    const auto proxy = fitting::enclose_parts({}, skin.view(), kAll);
    REQUIRE(proxy.ok());
    std::size_t left_out = 0;
    for (std::size_t t = 0; t < skin.mesh.triangles.size(); ++t) left_out += !held(*proxy, skin, t);
    CHECK(left_out == 0);
  }
}

TEST_CASE("enclose parts: the skin of an ellipsoid gives that ellipsoid") {
  const Skin skin = three_ellipsoids();
  const auto proxy = fitting::enclose_parts({}, skin.view(), kAll);
  REQUIRE(proxy.ok());
  REQUIRE(proxy->ellipsoids().size() == 3);
  const auto& head = proxy->ellipsoids()[0];
  CHECK(head.part == Part::kHead);
  CHECK((head.shape.center - Vec3(0, 0.88, 0)).norm() < 1e-3);
  Vec3 radii = head.shape.radii;
  std::ranges::sort(radii);
  CHECK((radii - Vec3(0.07, 0.09, 0.11)).norm() < 2e-3);
}

TEST_CASE("enclose parts: only wanted parts are enclosed, with the same bits for any number of workers") {
  const Skin skin = three_ellipsoids();
  const auto head = fitting::enclose_parts({}, skin.view(), bit(Part::kHead));
  REQUIRE(head.ok());
  CHECK(head->ellipsoids().size() == 1);
  const auto all = fitting::enclose_parts({}, skin.view(), kAll);
  for (const int workers : {1, 2, 3, 7}) {
    const auto executor = bodice_test::make_threads(workers);
    CHECK(fitting::enclose_parts({.executor = executor.get()}, skin.view(), kAll)->hash() == all->hash());
  }
  const auto none = fitting::enclose_parts({}, skin.view(), bit(Part::kCalfR));
  REQUIRE_FALSE(none.ok());
  CHECK(none.error().message.find("no skin") != std::string::npos);
}
