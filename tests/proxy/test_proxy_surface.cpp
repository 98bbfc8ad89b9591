#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/proxy/proxy_surface.hpp>
#include <bodice_test/executors.hpp>

#include "sample_proxy.hpp"

using namespace bodice;
using bodice_test::made;
using geometry::Vec3;

namespace {

/// An ellipsoid of radii 20, 30, 50 cm and a ball of 10 cm that does not touch it, times `scale`.
proxy::BodyProxy apart(double scale = 1.0, const Vec3& offset = Vec3::Zero()) {
  proxy::BodyProxy::Data data;
  data.tier = proxy::Tier::kTight;
  data.stature_m = 1.7 * scale;
  data.ellipsoids.resize(2);
  data.ellipsoids[0].shape.center = offset;
  data.ellipsoids[0].shape.radii = scale * Vec3(0.2, 0.3, 0.5);
  data.ellipsoids[1].shape.center = offset + scale * Vec3(1.0, 0.2, 0.0);
  data.ellipsoids[1].shape.radii = scale * Vec3::Constant(0.1);
  return made(data);
}

constexpr double kPi = 3.14159265358979323846;
const double kApartVolume = 4.0 / 3.0 * kPi * (0.2 * 0.3 * 0.5 + 0.1 * 0.1 * 0.1);

/// Whether each edge has two triangles, one in each direction.
bool is_closed(const geometry::TriMesh& mesh) {
  std::map<std::pair<geometry::Index, geometry::Index>, int> uses;
  for (const geometry::Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  return std::ranges::all_of(uses, [&](const auto& edge) {
    const auto reverse = uses.find({edge.first.second, edge.first.first});
    return edge.second == 1 && reverse != uses.end();
  });
}

/// The mesh as programs load it that merge vertices at one position.
geometry::TriMesh merged(const geometry::TriMesh& mesh) {
  std::map<std::array<double, 3>, geometry::Index> first;
  geometry::TriMesh out = mesh;
  for (geometry::Triangle& t : out.triangles)
    for (geometry::Index& v : t) {
      const Vec3& p = mesh.positions[v];
      v = first.emplace(std::array{p.x(), p.y(), p.z()}, v).first->second;
    }
  return out;
}

}  // namespace

TEST_CASE("proxy surface: two bodies apart are both found, closed, and of the right volume") {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(1e4, -2e4, 5e3)}) {
      if (scale < 1.0 && !offset.isZero()) continue;  // finer than the proxy's numbers
      const proxy::BodyProxy proxy = apart(scale, offset);
      const double cell_m = 0.01 * scale;
      const auto surface = proxy::proxy_surface({}, proxy, cell_m);
      REQUIRE(surface.ok());
      CHECK(is_closed(surface->mesh));
      CHECK(geometry::signed_volume(surface->mesh) / (scale * scale * scale) ==
            doctest::Approx(kApartVolume).epsilon(0.005));
      double off = 0.0, turned = 0.0;
      int balls = 0;
      for (std::size_t v = 0; v < surface->mesh.positions.size(); ++v) {
        const auto closest =
            geometry::closest_point(proxy.ellipsoids()[surface->owner[v]].shape, surface->mesh.positions[v]);
        off = std::max(off, std::abs(closest.signed_distance) / cell_m);
        turned = std::max(turned, (closest.normal - surface->normals[v]).norm());
        balls += surface->owner[v] == 1;
      }
      CHECK(off < 1.1e-3);
      CHECK(turned < 1e-9);
      CHECK(balls > 1000);
    }
}

TEST_CASE(
    "proxy surface: overlapping ellipsoids with tables make one surface, where their distance is zero") {
  proxy::BodyProxy::Data data = bodice_test::sample_data(5, 2, true);
  data.stature_m = 1.7;
  data.ellipsoids[0].shape.center = Vec3::Zero(), data.ellipsoids[0].shape.radii = Vec3(0.10, 0.20, 0.08);
  data.ellipsoids[1].shape.center = Vec3(0.11, 0.08, 0.0);
  data.ellipsoids[1].shape.radii = Vec3(0.12, 0.09, 0.10);
  constexpr std::uint16_t n = 9;
  data.relief.clear(), data.texels.clear();
  for (std::uint32_t k = 0; k < 2; ++k) {
    data.relief.push_back({n, 0.006f, -0.003f, 0.004f, -0.002f, k * n * n});
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec3 w = proxy::octahedral_direction(2.0 * i / (n - 1) - 1.0, 2.0 * j / (n - 1) - 1.0);
        data.texels.push_back({static_cast<std::uint8_t>(127.5 * (1.0 + w.x() * w.y())),
                               static_cast<std::uint8_t>(127.5 * (1.0 + w.z()))});
      }
  }
  const proxy::BodyProxy proxy = made(data);
  constexpr double cell_m = 0.004;
  const auto surface = proxy::proxy_surface({}, proxy, cell_m);
  REQUIRE(surface.ok());
  CHECK(is_closed(surface->mesh));
  int off = 0;
  for (const Vec3& p : surface->mesh.positions)
    off += std::abs(proxy::proxy_distance(proxy, p).distance) > 0.01 * cell_m;
  CHECK(off < 0.02 * static_cast<double>(surface->mesh.positions.size()));  // vertices at the crease
  // The volume is counted on a lattice that is unrelated to that of the surface.
  const Vec3 low(-0.15, -0.25, -0.15), size(0.45, 0.5, 0.3);
  constexpr int kSide = 60;
  int inside = 0;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const Vec3 u(i % kSide + 0.5, i / kSide % kSide + 0.5, i / (kSide * kSide) + 0.5);
    inside += proxy::proxy_distance(proxy, low + size.cwiseProduct(u / kSide)).distance < 0.0;
  }
  CHECK(geometry::signed_volume(surface->mesh) ==
        doctest::Approx(size.prod() * inside / (kSide * kSide * kSide)).epsilon(0.001));
}

TEST_CASE("proxy surface: where it touches itself within a cell, every edge still has two triangles") {
  constexpr double cell_m = 0.02;
  std::size_t touching = 0;
  for (int k = 0; k < 24; ++k) {  // rows of balls with gaps near a cell's diagonal, in many directions
    proxy::BodyProxy::Data data;
    data.stature_m = 1.7;
    const Vec3 step = Vec3(std::cos(k), std::sin(1.7 * k), std::cos(2.3 * k) + 0.1).normalized();
    for (int ball = 0; ball < 12; ++ball) {
      proxy::ProxyEllipsoid e;
      e.shape.radii = Vec3::Constant(0.03);
      e.shape.center = ball * (0.06 + 0.001 * ball) * step;
      data.ellipsoids.push_back(e);
    }
    const auto surface = proxy::proxy_surface({}, made(data), cell_m);
    REQUIRE(surface.ok());
    CHECK(is_closed(surface->mesh));
    CHECK(is_closed(merged(surface->mesh)));
    CHECK(surface->normals.size() == surface->mesh.positions.size());
    CHECK(surface->owner.size() == surface->mesh.positions.size());
    for (std::size_t v = 0; v < surface->mesh.positions.size(); ++v)
      touching +=
          std::abs(proxy::proxy_distance(made(data), surface->mesh.positions[v]).distance) > 0.01 * cell_m;
  }
  CHECK(touching > 0);
}

TEST_CASE("proxy surface: it includes the margin, and its bits do not depend on the workers") {
  proxy::BodyProxy::Data data;
  data.stature_m = 1.7, data.margin_m = 0.02;
  data.ellipsoids.resize(1);
  data.ellipsoids[0].shape.radii = Vec3::Constant(0.1);
  const proxy::BodyProxy proxy = made(data);
  const auto alone = proxy::proxy_surface({}, proxy, 0.01);
  REQUIRE(alone.ok());
  for (const Vec3& p : alone->mesh.positions) CHECK(std::abs(p.norm() - 0.12) < 1e-5);
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    const auto again = proxy::proxy_surface({.executor = executor.get()}, proxy, 0.01);
    REQUIRE(again.ok());
    CHECK(again->mesh.triangles == alone->mesh.triangles);
    CHECK(again->mesh.positions == alone->mesh.positions);
  }
}

TEST_CASE("proxy surface: an empty proxy gives none, and unusable cells are refused") {
  const auto nothing = proxy::proxy_surface({}, made({}), 0.01);
  REQUIRE(nothing.ok());
  CHECK(nothing->mesh.empty());
  for (const double cell_m : {0.0, -1.0, 1e-9, std::numeric_limits<double>::quiet_NaN()}) {
    const auto refused = proxy::proxy_surface({}, apart(), cell_m);
    REQUIRE(!refused.ok());
    CHECK(refused.error().code == engine::ErrorCode::kInvalidArgument);
  }
  const auto coarse = proxy::proxy_surface({}, apart(), 100.0);
  REQUIRE(coarse.ok());
  CHECK(is_closed(coarse->mesh));
}
