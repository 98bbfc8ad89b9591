// Edges and triangles stay out of the body, not only their particles.
#include <doctest/doctest.h>
#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>

#include "face_fixtures.hpp"
#include "faces/own_side.hpp"
#include "faces/push_sample.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

/// A sample at the middle of an edge from a to b, `sunk_m` below it, and what is known of the edge's ends.
struct EdgeSample {
  collision::Collider body;
  cloth::FaceContact faces;
  cloth::FaceSample sample;

  EdgeSample(std::span<const geometry::Ellipsoid> shapes, const Vec3& a, const Vec3& b, double sunk_m = 0.0)
      : body(collider_of(shapes)) {
    const auto contact = [&](const Vec3& at) {
      const Eigen::Vector3f p = (at - body.origin()).cast<float>();
      return body.query({p.x(), p.y(), p.z()});
    };
    faces.rules.keep_m = static_cast<float>(kThickness_m), faces.rules.spacing_m = 0.01f;
    faces.rules.sag_m = static_cast<float>(kSag_m);
    faces.nearest = {contact(a), contact(b)};
    const Vec3 middle = 0.5 * (a + b) - Vec3(0.0, sunk_m, 0.0);
    const collision::Contact here = contact(middle);
    sample.particle[1] = sample.particle[2] = 1;
    sample.weight[0] = sample.weight[1] = 0.5f;
    for (int axis = 0; axis < 3; ++axis) {
      sample.at[axis] = static_cast<float>(middle[axis] - body.origin()[axis]);
      sample.normal[axis] = here.normal[axis];
    }
    sample.distance_m = here.signed_distance;
  }
  /// The position to which the sample's push leads.
  Vec3 pushed() const {
    const Eigen::Map<const Eigen::Vector3f> at(sample.at), normal(sample.normal);
    return body.origin() + (at - sample.distance_m * normal).cast<double>();
  }
};

/// Whether a sample at the middle of an edge from a to b would be pushed.
bool middle_is_pushed(std::span<const geometry::Ellipsoid> shapes, const Vec3& a, const Vec3& b) {
  EdgeSample middle(shapes, a, b);
  return cloth::is_on_its_side(middle.sample, middle.faces) ||
         cloth::move_to_own_side(middle.body, middle.faces, middle.sample);
}

}  // namespace

TEST_CASE("face contact: a sample is pushed out between two toes, and never through a limb") {
  const std::vector<geometry::Ellipsoid> toes = {ellipsoid(Vec3(-0.01, 1, 0), Vec3(0.008, 0.008, 0.03)),
                                                 ellipsoid(Vec3(0.01, 1, 0), Vec3(0.008, 0.008, 0.03))};
  // This edge leads from the side of one toe that faces the other into the other, over the gap: the surfaces
  // oppose each other.
  CHECK(middle_is_pushed(toes, Vec3(-0.0025, 1.001, 0), Vec3(0.0075, 1.001, 0)));
  // One edge leads through a toe, from its left to just before its right side; the other runs along one side.
  const std::span<const geometry::Ellipsoid> toe(toes.data(), 1);
  CHECK(!middle_is_pushed(toe, Vec3(-0.019, 1.001, 0), Vec3(0.009, 1.001, 0)));
  CHECK(middle_is_pushed(toe, Vec3(-0.01, 1.009, -0.01), Vec3(-0.01, 1.0085, 0.01)));
}

TEST_CASE("face contact: a sample below the middle of a flat limb is pushed out on the side of its edge") {
  const geometry::Ellipsoid flat = ellipsoid(Vec3(0, 1, 0), Vec3(0.05, 0.01, 0.1));
  EdgeSample sunk(std::span(&flat, 1), Vec3(-0.02, 1.01, 0), Vec3(0.02, 1.01, 0), 0.012);
  CHECK(sunk.sample.normal[1] < -0.9f);
  CHECK(!cloth::is_on_its_side(sunk.sample, sunk.faces));
  REQUIRE(cloth::move_to_own_side(sunk.body, sunk.faces, sunk.sample));
  CHECK(cloth::is_on_its_side(sunk.sample, sunk.faces));
  CHECK(sunk.pushed().y() == doctest::Approx(1.01).epsilon(1e-4));
}

TEST_CASE(
    "face contact: the long edges of a tight sleeve keep the thickness; without face contact they cut in") {
  for (const bool on : {true, false}) {
    CAPTURE(on);
    Sleeve sleeve(on);
    cloth::FrameReport report;
    for (int frame = 0; frame < 60; ++frame) report = sleeve.solver->step({}, sleeve.body, kFrame_s);
    if (on) {
      CHECK(sleeve.nearest_now() > kThickness_m - kSag_m);
      CHECK(report.faces.contacts > 0);
      CHECK(report.faces.deepest_m <= 0.0f);
      CHECK(report.stretch_p95 < 0.2);  // the limb is wider than the sleeve by a tenth
    } else {
      CHECK(sleeve.nearest_now() < -2e-3);
      CHECK(report.faces.samples == 0);
    }
  }
}

TEST_CASE("face contact: a fingertip far from all corners carries the middle of a triangle") {
  // A ball of 8 mm stands under the middle of a taut triangle of 6 cm, and rises 3 cm in half a second.
  for (const bool on : {true, false}) {
    CAPTURE(on);
    std::vector<geometry::Ellipsoid> tip = {ellipsoid(Vec3(0, 0.99, 0), Vec3::Constant(0.008))};
    collision::Collider body = collider_of(tip);
    TriMesh mesh = sheet(10, 10, 0.6, 0.6, Vec3(-0.28, 1.0, -0.28));
    std::vector<Index> rim;
    for (Index j = 0; j <= 10; ++j)
      for (Index i = 0; i <= 10; ++i)
        if (i == 0 || j == 0 || i == 10 || j == 10) rim.push_back(11 * j + i);
    cloth::Solver solver = make_solver(mesh, rim, cotton(), options(on));
    double worst = 1.0;
    for (int frame = 0; frame < 30; ++frame) {
      tip[0].center.y() += 0.001;
      body.move_to(tip, kFrame_s);
      solver.step({}, body, kFrame_s);
      worst = std::min(worst, nearest(tip, positions(solver, mesh.positions.size()), mesh.triangles, 60));
    }
    if (on)
      CHECK(worst > -0.5e-3);  // samples are added in the frame after the one that shows the need
    else
      CHECK(worst < -5e-3);  // the ball stands through the cloth
  }
}

TEST_CASE("face contact: a limb that swings in its sleeve stays in it") {
  for (const bool on : {true, false}) {
    CAPTURE(on);
    Sleeve sleeve(on);
    double worst = 1.0, angle = 0.0;
    for (int frame = 0; frame < 60; ++frame) {
      angle += 2.0 * std::numbers::pi * kFrame_s * std::cos(0.1 * frame);  // at most 360 degrees a second
      sleeve.turn(angle);
      sleeve.solver->step({}, sleeve.body, kFrame_s);
      if (frame >= 10) worst = std::min(worst, sleeve.nearest_now());
    }
    if (on)
      CHECK(worst > -0.2e-3);
    else
      CHECK(worst < -2e-3);
  }
}

TEST_CASE("face contact: the same bits for any number of workers, and no allocation once warm") {
  cloth::SolverOptions how = options(true);
  how.certify_m = kCertified_m;
  auto run = [&](engine::Executor& executor) {
    Sleeve sleeve(how);
    const engine::Context context{.executor = &executor};
    for (int frame = 0; frame < 20; ++frame) sleeve.solver->step(context, sleeve.body, kFrame_s);
    return sleeve.solver->hash();
  };
  const std::uint64_t serial = run(engine::inline_executor());
  for (const int workers : {2, 3, 7}) CHECK(run(*make_threads(workers)) == serial);

  if (!bodice_test::counts_allocations()) return;
  Sleeve sleeve(how);
  sleeve.solver->step({}, sleeve.body, kFrame_s);
  const std::size_t before = bodice_test::allocations();
  for (int frame = 0; frame < 20; ++frame) {
    sleeve.limb.front().center.x() += 1e-3;
    sleeve.body.move_to(sleeve.limb, kFrame_s);
    sleeve.solver->step({}, sleeve.body, kFrame_s);
  }
  CHECK(bodice_test::allocations() == before);
}

TEST_CASE("face contact: a face of a meter beside faces of a millimeter keeps out of a limb") {
  const std::vector<geometry::Ellipsoid> limb = {ellipsoid(Vec3(0, 0.94, 0), Vec3(0.05, 0.05, 0.6))};
  const collision::Collider body = collider_of(limb);
  TriMesh mesh;
  mesh.positions = {Vec3(-0.5, 1.0, -0.4), Vec3(0.5, 1.0, -0.4), Vec3(0, 1.0, 0.5)};
  mesh.triangles = {{0, 2, 1}};
  for (Index k = 0; k < 40; ++k) {  // a strip of small faces hangs at a corner
    const Index right = 3 + 2 * k, left = right + 1;
    const double z = 0.501 + 0.001 * k;
    mesh.positions.insert(mesh.positions.end(), {Vec3(0.0005, 1.0, z), Vec3(-0.0005, 1.0, z)});
    if (k == 0)
      mesh.triangles.push_back({2, left, right});
    else
      mesh.triangles.insert(mesh.triangles.end(), {{right - 2, left, right}, {right - 2, left - 2, left}});
  }
  cloth::Solver solver = make_solver(mesh, {}, cotton(), options(true));
  cloth::FrameReport report;
  for (int frame = 0; frame < 20; ++frame) {
    report = solver.step({}, body, kFrame_s);
    REQUIRE(report.finite);
    CHECK(nearest(limb, positions(solver, mesh.positions.size()), {mesh.triangles[0]}, 200) > -1e-3);
  }
  CHECK(report.faces.samples > 100);
}

TEST_CASE("face contact: thicknesses of 0 and 50 mm hold between particles") {
  for (const double thickness_m : {0.0, 0.05}) {
    CAPTURE(thickness_m);
    const std::vector<geometry::Ellipsoid> limb = {ellipsoid(Vec3(0, 1, 0), Vec3(0.05, 0.6, 0.05))};
    const collision::Collider body = collider_of(limb);
    const TriMesh mesh = tube(0.0515 + thickness_m, 0.9, 1.1, 8, 5);
    cloth::SolverOptions o = options(true);
    o.thickness_m = thickness_m;
    cloth::Solver solver = make_solver(mesh, {}, cotton(), o);
    for (int frame = 0; frame < 60; ++frame) REQUIRE(solver.step({}, body, kFrame_s).finite);
    const double sag = std::max(0.25 * thickness_m, 1e-3);
    CHECK(nearest(limb, positions(solver, mesh.positions.size()), mesh.triangles) > thickness_m - sag);
  }
}

TEST_CASE("face contact: a garment wholly inside the body comes out") {
  const std::vector<geometry::Ellipsoid> ball = {ellipsoid(Vec3(0, 1, 0), Vec3::Constant(0.15))};
  const collision::Collider body = collider_of(ball);
  const TriMesh mesh = sheet(4, 4, 0.1, 0.1, Vec3(-0.05, 1.05, -0.05));
  cloth::Solver solver = make_solver(mesh, {}, cotton(), options(true));
  cloth::FrameReport report;
  for (int frame = 0; frame < 30; ++frame) report = solver.step({}, body, kFrame_s);
  CHECK(report.finite);
  CHECK(nearest(ball, positions(solver, mesh.positions.size()), mesh.triangles) > 0.0);
}

TEST_CASE("face contact: between two limbs no particle is pushed through either") {
  // A sheet hangs between two limbs that close on it until there is room for the thickness alone.
  std::vector<geometry::Ellipsoid> limbs = {ellipsoid(Vec3(-0.07, 1, 0), Vec3(0.05, 0.5, 0.05)),
                                            ellipsoid(Vec3(0.07, 1, 0), Vec3(0.05, 0.5, 0.05))};
  collision::Collider body = collider_of(limbs);
  TriMesh mesh = sheet(6, 6, 0.24, 0.3, Vec3::Zero());
  for (Vec3& p : mesh.positions) p = Vec3(0.0, 1.15 - p.z(), p.x() - 0.12);
  cloth::Solver solver = make_solver(mesh, {0, 1, 2, 3, 4, 5, 6}, cotton(), options(true));
  std::vector<Vec3> before = positions(solver, mesh.positions.size());
  for (int frame = 0; frame < 40; ++frame) {
    if (frame < 20)
      for (geometry::Ellipsoid& limb : limbs)
        limb.center.x() *= 1.0 - 0.019 / 20.0 / std::abs(limb.center.x());
    body.move_to(limbs, kFrame_s);
    REQUIRE(solver.step({}, body, kFrame_s).finite);
    const std::vector<Vec3> now = positions(solver, mesh.positions.size());
    for (std::size_t v = 7; v < now.size(); ++v) {
      CHECK(std::abs(now[v].x()) < 0.05);         // it stays between the axes of the limbs
      CHECK((now[v] - before[v]).norm() < 0.02);  // and does not jump
    }
    before = now;
  }
}

TEST_CASE("face contact: no corner moves farther than twice the push of a sample beside a pinned one") {
  const std::array<float, 3> free = {1.0f, 1.0f, 1.0f};
  for (const float share : {0.9f, 0.5f, 0.1f, 0.01f, 1e-6f}) {
    CAPTURE(share);
    const std::array<float, 3> weight = {share, 1.0f - share, 0.0f};
    const std::array<float, 3> pinned = {1.0f, 0.0f, 1.0f};
    CHECK(share / cloth::yielding_of(weight, pinned) <= 2.0f);
    // A sample without a pinned corner moves by the whole push.
    const float yielding = cloth::yielding_of(weight, free);
    CHECK((share * share + (1.0f - share) * (1.0f - share)) / yielding == doctest::Approx(1.0));
  }
}

TEST_CASE("face contact: pushes of one substep do not add up beyond the recovery speed") {
  constexpr float kSubstep_s = 1.0f / 960.0f;
  cloth::FaceContact faces;
  faces.rules.keep_m = static_cast<float>(kThickness_m), faces.rules.frame_s = 1.0f / 60.0f;
  faces.now = {{0.0f, 0.0f, 0.0f, 1.0f}, {0.03f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.03f, 1.0f}};
  faces.unpushed = faces.now;
  faces.nearest.assign(3, {.signed_distance = -0.005f});
  cloth::Particles particles;
  for (const cloth::Point& p : faces.now)
    particles.old_x.push_back(p.x), particles.old_y.push_back(p.y), particles.old_z.push_back(p.z);
  // One centimeter deep in the middle of a triangle that lies still.
  cloth::FaceSample sample;
  for (Index c = 0; c < 3; ++c) sample.particle[c] = c;
  sample.weight[0] = sample.weight[1] = 1.0f / 3.0f;
  sample.at[0] = sample.at[2] = 0.01f;
  sample.normal[0] = 0.0f, sample.normal[1] = 1.0f;
  sample.distance_m = -0.01f, sample.keep_m = faces.rules.keep_m;
  for (int push = 0; push < 5; ++push)
    CHECK(cloth::push_out(sample, {.length_s = kSubstep_s}, particles, faces));
  CHECK(position(sample, faces.now)[1] == doctest::Approx(kSubstep_s).epsilon(1e-3));
  // A sample with deeper corners is not pushed, because contact of particles moves these.
  faces.nearest.assign(3, {.signed_distance = -0.05f});
  CHECK_FALSE(cloth::push_out(sample, {.length_s = kSubstep_s}, particles, faces));
}

TEST_CASE("face contact: a sleeve that begins inside a limb comes out slowly, and is not thrown") {
  // The sleeve, which is held inside by its upper rim, is narrower than the limb by a fifth or by a half.
  // Particles alone can come out of the former within a frame.
  for (const double radius_m : {0.064, 0.1}) {
    CAPTURE(radius_m);
    Sleeve sleeve(true);
    sleeve.limb.front().radii = Vec3(radius_m, 0.6, radius_m);
    sleeve.body = collider_of(sleeve.limb);
    const std::vector<Vec3> start = positions(*sleeve.solver, sleeve.mesh.positions.size());
    const cloth::FrameReport report = sleeve.solver->step({}, sleeve.body, kFrame_s);
    double farthest_m = 0.0;
    const std::vector<Vec3> now = positions(*sleeve.solver, start.size());
    for (std::size_t v = 0; v < start.size(); ++v)
      farthest_m = std::max(farthest_m, (now[v] - start[v]).norm());
    CHECK(report.faces.contacts > 0);
    CAPTURE(farthest_m);
    CHECK(farthest_m < 0.04);
  }
}
