// Guards, crossings and untangling: how layers cross where a body leaves no room, and come apart again.
#include <doctest/doctest.h>

#include "contact/sunk_particles.hpp"
#include "layer_fixtures.hpp"
#include "selfcontact/self_contact.hpp"
#include "selfcontact/tangles.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

using cloth::Point;

constexpr double kRadius_m = 0.2;

Point to_point(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 1.0f};
}

Vec3 to_vec(const Point& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

/// Heights of a particle over the top of a ball: after contact with the body, after layers moved it, and
/// where its guard keeps it.
struct Moved {
  double from_m, to_m, kept_m;

  bool sinks() const { return kept_m > to_m; }
};

constexpr Moved kMoved[] = {
    {kThickness_m, kThickness_m - 0.02e-3, kThickness_m},            // by 20 micrometers
    {kThickness_m, kThickness_m + 0.02e-3, kThickness_m + 0.02e-3},  // outward
    {-3e-3, -3.1e-3, -3e-3},                                         // deeper where it was inside before
    {-3e-3, -2.9e-3, -2.9e-3},
    {8e-3, kThickness_m + 0.1e-3, kThickness_m + 0.1e-3},  // toward the body, but not to it
    {8e-3, kThickness_m - 0.1e-3, kThickness_m},
};

/// The same with a least distance of half a millimeter inside the body.
constexpr double kYielded_m = -0.5e-3;
constexpr Moved kYielding[] = {
    {kThickness_m, -0.4e-3, -0.4e-3},
    {kThickness_m, -0.6e-3, kYielded_m},
    {-3e-3, -2.9e-3, -2.9e-3},
    {-3e-3, -3.1e-3, -3e-3},
};

void check_guards(std::span<const Moved> list, double least_m) {
  const collision::Collider ball = ellipsoid_body(Vec3(0, -kRadius_m, 0), Vec3::Constant(kRadius_m));
  const Vec3 top = -ball.origin();  // in the particles' frame
  const cloth::BodyMotion still = cloth::make_motion(list.size(), 0.0);
  std::vector<Point> resolved, now;
  std::vector<Index> moved;
  for (const Moved& m : list) {
    moved.push_back(static_cast<Index>(moved.size()));
    resolved.push_back(to_point(top + Vec3(0, m.from_m, 0)));
    now.push_back(to_point(top + Vec3(0, m.to_m, 0)));
  }
  std::vector<cloth::Guard> guard(moved.size());
  const cloth::ResolvedBody body{&ball, &still, static_cast<float>(kThickness_m),
                                 static_cast<float>(least_m)};
  CHECK(cloth::guard_sunk({}, body, moved, resolved, now, guard));
  for (const Index i : moved) {
    CAPTURE(i);
    CHECK(cloth::is_guarded(guard[i]) == list[i].sinks());
    Point kept;
    cloth::store(kept, cloth::guarded(cloth::load(now[i]), resolved[i], guard[i]));
    CHECK(std::abs((to_vec(kept) - top).y() - list[i].kept_m) < 1e-6);
  }
  CHECK(!cloth::guard_sunk({}, {}, moved, resolved, now, guard));
}

/// A sheet across another one: it rises along x, through the other's plane at `crossing_m`.
struct Crossed {
  TriMesh mesh;
  cloth::ContactMesh contact;

  explicit Crossed(double crossing_m) {
    mesh = sheet(20, 6, 1.0, 0.3, Vec3::Zero());
    append(sheet(20, 6, 1.0, 0.3, Vec3(0.013, 0.0, 0.017)), mesh);
    for (std::size_t i = mesh.positions.size() / 2; i < mesh.positions.size(); ++i)
      mesh.positions[i].y() = 0.2 * (mesh.positions[i].x() - crossing_m);
    contact = cloth::make_contact_mesh(mesh);
  }

  cloth::Particles particles() const {
    return cloth::make_particles(mesh, 0.1, std::vector<bool>(mesh.positions.size(), false));
  }

  /// All triangles that cross, by brute force.
  std::vector<cloth::Tangle> tangles() const {
    std::vector<cloth::Tangle> out;
    for (const auto& [s, t] : geometry::find_crossings(mesh.positions, mesh.triangles)) {
      const auto a = face_of(mesh.triangles[s]), b = face_of(mesh.triangles[t]);
      out.push_back({std::min(a, b), std::max(a, b)});
    }
    std::ranges::sort(out);
    return out;
  }

  std::uint32_t face_of(const geometry::Triangle& t) const {
    for (std::uint32_t f = 0; f < contact.faces.size(); ++f)
      if (std::ranges::equal(contact.faces[f].particle, t)) return f;
    FAIL("there is no such face");
    return 0;
  }
};

}  // namespace

TEST_CASE("sunk particles: a particle that layers move into the body gets a guard, and no other particle") {
  check_guards(kMoved, kThickness_m);
}

TEST_CASE("sunk particles: a smaller least distance lets them come nearer, but not deeper than they were") {
  check_guards(kYielding, kYielded_m);
}

TEST_CASE(
    "sunk particles: between two walls, a push along the first guard gives a guard of the second wall") {
  // The surfaces of two balls are 6 mm apart where they are nearest; the particle begins on the left one.
  const std::vector<geometry::Ellipsoid> walls = {
      ellipsoid(Vec3(-kRadius_m - 3e-3, 0, 0), Vec3::Constant(kRadius_m)),
      ellipsoid(Vec3(kRadius_m + 3e-3, 0, 0), Vec3::Constant(kRadius_m))};
  const collision::Collider body = collider_of(walls);
  const cloth::BodyMotion still = cloth::make_motion(1, 0.0);
  const auto thickness = static_cast<float>(kThickness_m);
  const cloth::ResolvedBody resolved_body{&body, &still, thickness, thickness};
  const auto in_frame = [&](double x_m) { return to_point(Vec3(x_m, 0, 0) - body.origin()); };
  const Point resolved = in_frame(-3e-3 + kThickness_m);
  const std::vector<Index> moved = {0};
  std::vector<cloth::Guard> guard(1);
  std::vector<Point> now = {in_frame(-3e-3 + 0.5 * kThickness_m)};
  REQUIRE(cloth::guard_sunk({}, resolved_body, moved, {&resolved, 1}, now, guard));
  CHECK(guard[0].x > 0.99f);
  now[0] = in_frame(3e-3 - 0.5 * kThickness_m);  // it is pushed across the gap, into the other wall
  REQUIRE(cloth::guard_sunk({}, resolved_body, moved, {&resolved, 1}, now, guard));
  CHECK(guard[0].x < -0.99f);
  Point kept;
  cloth::store(kept, cloth::guarded(cloth::load(now[0]), resolved, guard[0]));
  CHECK(std::abs(to_vec(kept).x() + body.origin().x() - (3e-3 - kThickness_m)) < 1e-5);
}

TEST_CASE("crossings: all triangles that cross are found after layers passed far through each other") {
  const Crossed before(0.31), after(0.62);
  const cloth::Particles particles = after.particles();
  cloth::SelfContact self = cloth::make_self_contact(after.mesh, particles, 1.5e-3, 0.05);
  self.tangles = before.tangles();
  REQUIRE(self.tangles.size() > 10);
  cloth::begin_self_contact({}, particles, self);
  CHECK(self.tangles == after.tangles());
  for (const cloth::Tangle& t : self.tangles)
    for (const std::uint32_t f : {t.a, t.b})
      for (const Index i : self.mesh.faces[f].particle) CHECK(self.loose.is_corner[i] != 0);
}

TEST_CASE(
    "tangles: untangling moves no particle farther than a step, and none where both triangles lie on the "
    "body") {
  constexpr float kStep_m = 1e-3f;
  const Crossed crossed(0.31);
  std::vector<Point> start, at, room;
  for (const Vec3& p : crossed.mesh.positions) start.push_back(to_point(p));
  room.resize(start.size());
  cloth::Loose loose = cloth::make_loose(start.size());
  cloth::loosen(crossed.contact, crossed.tangles(), start, loose);
  const std::vector<float> inverse_mass(start.size(), 1.0f);
  for (const bool on_body : {false, true}) {
    CAPTURE(on_body);
    const std::vector<std::uint8_t> touching(start.size(), on_body);
    at = start;
    cloth::untangle(crossed.contact, crossed.tangles(), {touching, inverse_mass, loose, kStep_m}, room, at);
    double farthest_m = 0.0;
    for (Index i = 0; i < at.size(); ++i)
      farthest_m = std::max(farthest_m, (to_vec(at[i]) - to_vec(start[i])).norm());
    CHECK(farthest_m <= 1.001 * static_cast<double>(kStep_m));
    CHECK((farthest_m > 0.0) == !on_body);
  }
}
