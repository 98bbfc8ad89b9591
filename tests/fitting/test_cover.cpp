#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/sampling.hpp>
#include <bodice/proxy/proxy_distance.hpp>

#include "cover/cover.hpp"
#include "cover/cover_pieces.hpp"
#include "shapes.hpp"

using namespace bodice;
using fitting_test::Skin;
using fitting_test::three_ellipsoids;
using geometry::Vec3;

namespace {

/// A body with limbs that bend and meet, so that no single ellipsoid follows any of them.
Skin bent_body() {
  Skin skin = three_ellipsoids();
  for (Vec3& p : skin.mesh.positions) {
    p.x() += 0.08 * std::sin(7.0 * p.y());
    p.z() *= 1.0 + 0.25 * std::cos(15.0 * p.y());
  }
  return skin;
}

/// The largest distance of a point of a triangle to the union, over corners, a middle of two edges, and the
/// center.
double deepest_uncovered(const Skin& skin, const proxy::BodyProxy& proxy) {
  double deepest = 0.0;
  for (std::size_t t = 0; t < skin.mesh.triangles.size(); ++t)
    for (const Vec3& w : {Vec3(1, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0, 0.5, 0.5), Vec3(Vec3(1, 1, 1) / 3.0)}) {
      const Vec3 p =
          w[0] * skin.mesh.corner(t, 0) + w[1] * skin.mesh.corner(t, 1) + w[2] * skin.mesh.corner(t, 2);
      double least = 1e300;
      for (const auto& e : proxy.ellipsoids())
        least = std::min(least, geometry::closest_point(e.shape, p).signed_distance);
      deepest = std::max(deepest, least);
    }
  return deepest;
}

/// The number of random points inside the skin, out of 3000, that no ellipsoid holds.
int leaks(const Skin& skin, const geometry::MeshDistance& distance, const proxy::BodyProxy& proxy) {
  engine::Random random(12);
  const geometry::Box box = geometry::bounding_box(skin.mesh.positions);
  int outside = 0, inside = 0;
  while (inside < 3000) {
    const Vec3 u(random.uniform(), random.uniform(), random.uniform());
    const Vec3 p = box.low + u.cwiseProduct(box.size());
    if (!distance.inside(p)) continue;
    ++inside;
    bool held = false;
    for (const auto& e : proxy.ellipsoids()) held = held || geometry::level(e.shape, p) <= 1.0;
    outside += !held;
  }
  return outside;
}

}  // namespace

TEST_CASE("solid: at any count, no skin and no point of the interior is left out" *
          doctest::test_suite("long")) {
  const Skin skin = bent_body();
  const geometry::MeshDistance distance({}, skin.mesh);
  fitting::FitOptions options;
  options.tier = proxy::Tier::kSolid;
  for (const int count : {1, 2, 3, 8, 16, 32, 55, 89, 200, 400}) {
    CAPTURE(count);
    options.max_ellipsoids = count;
    auto view = skin.view();
    view.distance = &distance;
    const auto result = fitting::fit({}, view, options);
    REQUIRE(result.ok());
    CHECK(result->proxy.ellipsoids().size() <= static_cast<std::size_t>(count));
    CHECK(deepest_uncovered(skin, result->proxy) <= 1e-9);
    CHECK(leaks(skin, distance, result->proxy) == 0);
  }
}

TEST_CASE("solid: a cavity that no column passes through is found and filled") {
  const geometry::Mat3 upright = geometry::Mat3::Identity();
  Skin skin;
  fitting_test::add_ellipsoid(skin, {Vec3::Zero(), upright, Vec3::Constant(0.1)}, body::Part::kTorsoUL);
  // Four balls hold all of it except a cavity of a few millimeters around the middle.
  std::vector<geometry::Ellipsoid> balls;
  for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
    balls.push_back({0.3 * corner.normalized(), upright, Vec3::Constant(0.298)});
  const auto held = [&](const Vec3& p) {
    return std::ranges::any_of(balls, [&](const auto& e) { return geometry::level(e, p) <= 1.0; });
  };
  const auto outside = [&] {
    engine::Random random(3);
    int count = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 u(random.uniform(), random.uniform(), random.uniform());
      const Vec3 p = 0.19 * u - Vec3::Constant(0.095);
      count += p.norm() < 0.095 && !held(p);
    }
    for (int i = 0; i < 20000; ++i) {
      const Vec3 u(random.uniform(), random.uniform(), random.uniform());
      count += !held(0.014 * u - Vec3::Constant(0.007));
    }
    return count;
  };
  REQUIRE(outside() > 500);
  const auto columns = fitting::interior_columns(skin.mesh, 0.05);
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i)
      REQUIRE(std::hypot(columns.x(i), columns.z(k)) > 0.0063);  // every column misses the cavity
  const geometry::MeshDistance distance({}, skin.mesh);
  CHECK(fitting::cover_interior({}, columns, distance, balls) == 0.0);  // no column had a hole
  CHECK(outside() == 0);
}

TEST_CASE("tight: a fit with covering leaves no skin outside, one without it does" *
          doctest::test_suite("long")) {
  const Skin skin = bent_body();
  fitting::FitOptions options;
  options.tier = proxy::Tier::kTight;
  options.max_ellipsoids = 12;
  const auto balanced = fitting::fit({}, skin.view(), options);
  options.covering = true;
  const auto covering = fitting::fit({}, skin.view(), options);
  REQUIRE((balanced.ok() && covering.ok()));
  CHECK(deepest_uncovered(skin, balanced->proxy) > 5e-4);
  CHECK(deepest_uncovered(skin, covering->proxy) <= 1e-9);
  CHECK(covering->accuracy.gap_m.mean > balanced->accuracy.gap_m.mean);
}

TEST_CASE("tight: with covering, skin that dips into another limb is covered up to where it dips" *
          doctest::test_suite("long")) {
  // Triangles are a decimeter long; those across the seam have buried corners.
  const geometry::Ellipsoid left{Vec3(-0.1, 0.5, 0), geometry::Mat3::Identity(), Vec3(0.15, 0.4, 0.15)};
  const geometry::Ellipsoid right{Vec3(0.1, 0.5, 0), geometry::Mat3::Identity(), Vec3(0.15, 0.4, 0.15)};
  Skin skin;
  fitting_test::add_ellipsoid(skin, left, body::Part::kThighL, 6);
  fitting_test::add_ellipsoid(skin, right, body::Part::kThighR, 6);
  skin.stature_m = 1.0;
  fitting::FitOptions options;
  options.tier = proxy::Tier::kTight;
  options.max_ellipsoids = 30;
  options.covering = true;
  const auto covering = fitting::fit({}, skin.view(), options);
  REQUIRE(covering.ok());
  double deepest = 0.0;
  int seam = 0;
  for (const auto& sample : geometry::sample_surface(skin.mesh, 20000, 5)) {
    const bool of_left = sample.triangle < skin.mesh.triangles.size() / 2;
    if (geometry::level(of_left ? right : left, sample.point) < 1.0)
      continue;  // the point is in the other limb
    seam += std::abs(sample.point.x()) < 0.02;
    deepest = std::max(deepest, proxy::proxy_distance(covering->proxy, sample.point).distance);
  }
  CHECK(seam > 50);
  CHECK(deepest <= 1e-9);
}

TEST_CASE("relax cover: an ellipsoid shrinks where no triangle needs it, and every triangle stays held") {
  const geometry::Ellipsoid anchor{Vec3(0, 0.5, 0), geometry::Mat3::Identity(), Vec3(0.1, 0.2, 0.1)};
  Skin skin;
  fitting_test::add_ellipsoid(skin, anchor, body::Part::kTorsoUL);
  std::vector<geometry::Index> all(skin.mesh.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<geometry::Index>(t);
  // Each of two ellipsoids alone holds everything; one of them is much larger than necessary.
  std::vector<geometry::Ellipsoid> shapes(2, anchor);
  shapes[0].radii *= 1.05;
  shapes[1].radii *= 1.6;
  const double before = geometry::volume(shapes[1]);
  fitting::relax_cover({}, skin.mesh, all, std::vector(2, anchor), shapes);
  CHECK(geometry::volume(shapes[0]) + geometry::volume(shapes[1]) < 0.6 * before);
  for (const auto& triangle : skin.mesh.triangles) {
    const auto held_by = [&](const geometry::Ellipsoid& e) {
      return std::ranges::all_of(
          triangle, [&](geometry::Index v) { return geometry::level(e, skin.mesh.positions[v]) <= 1.0; });
    };
    CHECK(std::ranges::any_of(shapes, held_by));
  }
}

TEST_CASE("relax cover: a triangle that only one ellipsoid holds stays held") {
  const geometry::Mat3 upright = geometry::Mat3::Identity();
  Skin skin;
  fitting_test::add_ellipsoid(skin, {Vec3(0, 0.5, 0), upright, Vec3(0.1, 0.4, 0.1)}, body::Part::kTorsoUL);
  std::vector<geometry::Index> all(skin.mesh.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<geometry::Index>(t);
  // Both hold the middle, each holds its own end.
  std::vector<geometry::Ellipsoid> shapes{{Vec3(0, 0.7, 0), upright, Vec3(0.3, 0.4, 0.3)},
                                          {Vec3(0, 0.3, 0), upright, Vec3(0.3, 0.4, 0.3)}};
  const std::vector<geometry::Ellipsoid> anchors{{Vec3(0, 0.7, 0), upright, Vec3(0.02, 0.02, 0.02)},
                                                 {Vec3(0, 0.3, 0), upright, Vec3(0.02, 0.02, 0.02)}};
  fitting::relax_cover({}, skin.mesh, all, anchors, shapes);
  for (const auto& triangle : skin.mesh.triangles)
    CHECK(std::ranges::any_of(shapes, [&](const geometry::Ellipsoid& e) {
      return std::ranges::all_of(
          triangle, [&](geometry::Index v) { return geometry::level(e, skin.mesh.positions[v]) <= 1.0; });
    }));
}

TEST_CASE("cut at creases: triangles across a crease are cut, the others and the skin's area stay the same") {
  const geometry::Mat3 upright = geometry::Mat3::Identity();
  Skin skin;
  fitting_test::add_ellipsoid(skin, {Vec3(0, 0.5, 0), upright, Vec3(0.1, 0.4, 0.1)}, body::Part::kTorsoUL);
  skin.stature_m = 1.7;
  std::vector<geometry::Index> all(skin.mesh.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<geometry::Index>(t);
  const std::vector<geometry::Ellipsoid> halves{{Vec3(0, 0.3, 0), upright, Vec3(0.1, 0.2, 0.1)},
                                                {Vec3(0, 0.7, 0), upright, Vec3(0.1, 0.2, 0.1)}};
  const auto area = [](const geometry::TriMesh& mesh) {
    double sum = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += geometry::area_vector(mesh, t).norm();
    return sum;
  };
  const auto pieces = fitting::cut_at_creases(skin.view(), all, halves);
  CHECK(area(pieces.mesh) == doctest::Approx(area(skin.mesh)).epsilon(1e-12));
  CHECK(pieces.mesh.triangles.size() > all.size() + 3 * 48);  // at least once around the waist
  std::size_t whole = 0;
  for (const auto& t : pieces.mesh.triangles)
    whole += std::ranges::all_of(t, [&](geometry::Index v) { return v < skin.mesh.positions.size(); });
  CHECK(whole > all.size() - 6 * 48);  // and nowhere else
  CHECK(whole < all.size());
  CHECK(fitting::cut_at_creases(skin.view(), all, std::span(halves).first(1)).mesh.triangles.size() ==
        all.size());
}
