// The rules by which layers cross where a body leaves no room, and come apart again.
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

/// Two particles' positions, at heights over the top of a ball: where the body left one, and where layers
/// moved it.
struct Moved {
  double from_m, to_m;
  bool sinks;
};

constexpr Moved kMoved[] = {
    {kThickness_m, kThickness_m - 0.02e-3, true},   // by 20 micrometers
    {kThickness_m, kThickness_m + 0.02e-3, false},  // outward
    {-3e-3, -3.1e-3, true},                         // deeper where it was inside before
    {-3e-3, -2.9e-3, false},
    {8e-3, kThickness_m + 0.1e-3, false},  // toward the body, but not to it
    {8e-3, kThickness_m - 0.1e-3, true},
};

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

TEST_CASE("sunk particles: what layers move into the body is guarded, by however little, and nothing else") {
  const collision::Collider ball = ellipsoid_body(Vec3(0, -kRadius_m, 0), Vec3::Constant(kRadius_m));
  const Vec3 top = -ball.origin();  // in the particles' frame
  const cloth::BodyMotion still = cloth::make_motion(std::size(kMoved), 0.0);
  std::vector<Point> resolved, now, guard;
  std::vector<Index> moved;
  for (const Moved& m : kMoved) {
    moved.push_back(static_cast<Index>(moved.size()));
    resolved.push_back(to_point(top + Vec3(0, m.from_m, 0)));
    now.push_back(to_point(top + Vec3(0, m.to_m, 0)));
  }
  guard.resize(moved.size());
  const cloth::ResolvedBody body{&ball, &still, static_cast<float>(kThickness_m), 0.0f};
  CHECK(cloth::guard_sunk({}, body, moved, resolved, now, guard));
  for (const Index i : moved) {
    CAPTURE(i);
    CHECK((guard[i].weight != 0.0f) == kMoved[i].sinks);
    Point kept;
    cloth::store(kept, cloth::guarded(cloth::load(now[i]), resolved[i], guard[i]));
    const double wanted_m = kMoved[i].sinks ? kMoved[i].from_m : kMoved[i].to_m;
    CHECK(std::abs((to_vec(kept) - top).y() - wanted_m) < 1e-6);
  }
  CHECK(!cloth::guard_sunk({}, {}, moved, resolved, now, guard));
}

TEST_CASE("crossings: layers that passed each other far in a frame are found to cross, all of them") {
  const Crossed before(0.31), after(0.62);
  const cloth::Particles particles = after.particles();
  cloth::SelfContact self = cloth::make_self_contact(after.mesh, particles, 1.5e-3, 0.05);
  self.tangles = before.tangles();
  REQUIRE(self.tangles.size() > 10);
  cloth::begin_self_contact({}, particles, self);
  CHECK(self.tangles == after.tangles());
  for (const cloth::Tangle& t : self.tangles)
    for (const std::uint32_t f : {t.a, t.b})
      for (const Index i : self.mesh.faces[f].particle) CHECK(self.loose.state[i] != 0);
}

TEST_CASE("tangles: what is drawn apart moves no farther than a step, and stays where both lie on the body") {
  constexpr float kStep_m = 1e-3f;
  const Crossed crossed(0.31);
  std::vector<Point> start, at, room;
  std::vector<Index> all;
  for (const Vec3& p : crossed.mesh.positions) start.push_back(to_point(p));
  for (Index i = 0; i < start.size(); ++i) all.push_back(i);
  room.resize(start.size());
  for (const bool on_body : {false, true}) {
    CAPTURE(on_body);
    const std::vector<std::uint8_t> touching(start.size(), on_body);
    at = start;
    cloth::untangle(crossed.contact, crossed.tangles(), {touching, all, kStep_m}, room, at);
    double farthest_m = 0.0;
    for (const Index i : all) farthest_m = std::max(farthest_m, (to_vec(at[i]) - to_vec(start[i])).norm());
    CHECK(farthest_m <= 1.001 * static_cast<double>(kStep_m));
    CHECK((farthest_m > 0.0) == !on_body);
  }
}
