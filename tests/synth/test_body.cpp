#include <bodice/synth/body.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <bodice/engine/hash.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice_test/executors.hpp>

#include "made_body.hpp"
#include "mesh_facts.hpp"

namespace {

using namespace bodice;
using bodice_test::joint;
using bodice_test::made;
using bodice_test::mark;
using body::LandmarkId;
using body::Part;
using geometry::Vec3;
using synth::BodyOptions;
using synth::Pose;

constexpr std::array kAllPoses = {Pose::kA,      Pose::kT,     Pose::kArmsDown,  Pose::kArmsUp,
                                  Pose::kStride, Pose::kSit,   Pose::kSquat,     Pose::kRun,
                                  Pose::kKick,   Pose::kLying, Pose::kHandstand, Pose::kRandom};

double height(const synth::Body& body) {
  return geometry::bounding_box(body.mesh.positions).size().y();
}

std::uint64_t hash(const synth::Body& body) {
  engine::Hasher h;
  for (const Vec3& p : body.mesh.positions)
    for (int c = 0; c < 3; ++c) h.add(p[c]);
  for (const auto& t : body.mesh.triangles)
    for (const auto v : t) h.add(v);
  for (const Part part : body.part) h.add(part);
  for (const auto& landmark : body.landmarks)
    for (int c = 0; c < 3; ++c) h.add(landmark.position[c]);
  return h.value();
}

TEST_CASE("every pose is a closed surface of one component and genus 0") {
  for (const Pose pose : kAllPoses)
    for (const std::uint64_t seed : {0, 7}) {
      CAPTURE(static_cast<int>(pose));
      const synth::Body body = made({.pose = pose, .vertices = 3000, .seed = seed});
      const auto facts = bodice_test::facts_of(body.mesh);
      CHECK(facts.euler == 2);
      CHECK(facts.components == 1);
      CHECK(facts.boundary_edges == 0);
      CHECK(facts.repeated_half_edges == 0);
      CHECK(geometry::signed_volume(body.mesh) > 0.0);
      const auto box = geometry::bounding_box(body.mesh.positions);
      CHECK(std::abs(box.low.y()) < 1e-12);
      CHECK(box.size().allFinite());
    }
}

TEST_CASE("the requested number of vertices is met within ten percent") {
  for (const int vertices : {1500, 1900, 2600, 4508, 8850, 13380, 53514, 210000}) {
    const synth::Body body = made({.vertices = vertices});
    CHECK(static_cast<double>(body.mesh.positions.size()) == doctest::Approx(vertices).epsilon(0.1));
    const auto facts = bodice_test::facts_of(body.mesh);
    CHECK(static_cast<double>(facts.slivers) < 0.002 * static_cast<double>(body.mesh.triangles.size()));
  }
}

TEST_CASE("a standing body has the requested stature, and its volume the requested mass") {
  struct Case {
    body::Sex sex;
    double stature, mass;
  };
  using enum body::Sex;
  for (const Case& c : {Case{kFemale, 1.68, 62},
                        {kMale, 1.78, 78},
                        {kFemale, 1.6, 45},
                        {kMale, 1.9, 68},
                        {kFemale, 1.65, 115},
                        {kMale, 1.75, 150},
                        {kMale, 0.4, 2.0},
                        {kFemale, 2.6, 110},
                        {kFemale, 1.7, 29.0},
                        {kMale, 1.7, 202.0}}) {
    CAPTURE(c.stature);
    CAPTURE(c.mass);
    BodyOptions options{
        .sex = c.sex, .stature_m = c.stature, .mass_kg = c.mass, .pose = Pose::kArmsDown, .vertices = 6000};
    CHECK(height(made(options)) == doctest::Approx(c.stature).epsilon(0.01));
    options.pose = Pose::kA;
    const synth::Body a = made(options);
    CHECK(1010.0 * geometry::signed_volume(a.mesh) == doctest::Approx(c.mass).epsilon(0.08));
    CHECK(a.stature_m == c.stature);
  }
}

TEST_CASE("landmarks lie on the skin or, for girths, inside it, where anatomy has them") {
  for (const Pose pose : {Pose::kA, Pose::kSit, Pose::kHandstand, Pose::kRandom}) {
    CAPTURE(static_cast<int>(pose));
    const synth::Body body = made({.pose = pose, .seed = 3});
    const geometry::MeshDistance skin({}, body.mesh);
    REQUIRE(body.landmarks.size() == static_cast<std::size_t>(body::kLandmarkCount));
    for (int k = 0; k < body::kLandmarkCount; ++k) {
      const body::Landmark& landmark = body.landmarks[static_cast<std::size_t>(k)];
      CAPTURE(std::string(body::name(landmark.id)));
      CHECK(static_cast<int>(landmark.id) == k);
      CHECK(landmark.confidence == 1.0);
      REQUIRE(landmark.vertex < body.mesh.positions.size());
      const double depth = -skin.signed_distance(landmark.position);
      const std::string_view name = body::name(landmark.id);
      const bool girth = name == "neck" || name == "underbust" || name == "waist" || name == "hip" ||
                         name.starts_with("elbow") || name.starts_with("knee") || name.starts_with("wrist") ||
                         name.starts_with("ankle");
      if (girth)
        CHECK(depth > 0.008 * body.stature_m);
      else
        CHECK(std::abs(depth) < 1e-6);
    }
    const double h = body.stature_m;
    CHECK((mark(body, LandmarkId::kElbowL) - joint(body, "elbow_l")).norm() < 0.02 * h);
    CHECK((mark(body, LandmarkId::kKneeR) - joint(body, "knee_r")).norm() < 0.025 * h);
    CHECK((mark(body, LandmarkId::kNeck) - joint(body, "neck")).norm() < 0.03 * h);
    CHECK((mark(body, LandmarkId::kArmpitL) - joint(body, "shoulder_l")).norm() < 0.11 * h);
  }
}

TEST_CASE("the standing average has the survey's heights") {
  for (const body::Sex sex : {body::Sex::kFemale, body::Sex::kMale}) {
    const body::Proportions p = body::find_profile("ansur2").value().of(sex);
    const synth::Body body = made({.sex = sex, .stature_m = 1.7, .mass_kg = 65.0, .pose = Pose::kArmsDown});
    const auto share = [&](LandmarkId id) { return mark(body, id).y() / 1.7; };
    CHECK(share(LandmarkId::kCrown) == doctest::Approx(1.0).epsilon(0.01));
    CHECK(std::abs(share(LandmarkId::kPerineum) - p.crotch_height) < 0.02);
    // The height at which a knee turns is from: Drillis, Contini. Body segment parameters. 1966. It is not
    // the survey's tibiale.
    CHECK(std::abs(share(LandmarkId::kKneeL) - 0.285) < 0.01);
    CHECK(std::abs(share(LandmarkId::kNeck) - p.neck_height) < 0.03);
    CHECK(std::abs(share(LandmarkId::kArmpitL) - p.axilla_height) < 0.03);
    // In rigged scans the elbow lies at .49 to .53 of the distance from shoulder to wrist.
    const double upper = (joint(body, "elbow_l") - joint(body, "shoulder_l")).norm();
    const double lower = (joint(body, "wrist_l") - joint(body, "elbow_l")).norm();
    CHECK(std::abs(upper / (upper + lower) - 0.51) < 0.02);
    const double arm = (mark(body, LandmarkId::kFingertipL) - mark(body, LandmarkId::kElbowL)).norm() / 1.7;
    CHECK(std::abs(arm - p.fingertip_to_elbow) < 0.025);
  }
}

TEST_CASE("every part exists, on its own side, and adjacent parts meet at their joint") {
  const synth::Body body = made({.pose = Pose::kA});
  std::array<int, body::kPartCount> count{};
  for (std::size_t v = 0; v < body.part.size(); ++v) {
    ++count[static_cast<std::size_t>(body.part[v])];
    const std::string_view name = body::name(body.part[v]);
    if (!body::is_torso(body.part[v]) && name.ends_with("_l")) CHECK(body.mesh.positions[v].x() > -1e-9);
  }
  for (const int n : count) CHECK(n > 20);
  const auto border_at = [&](Part one, Part other, std::string_view at, double within) {
    int edges = 0;
    for (const auto& t : body.mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        const auto a = t[k], b = t[(k + 1) % 3];
        if (body.part[a] != one || body.part[b] != other) continue;
        ++edges;
        CHECK((body.mesh.positions[a] - joint(body, at)).norm() < within * body.stature_m);
      }
    CHECK(edges > 5);
  };
  border_at(Part::kThighL, Part::kCalfL, "knee_l", 0.07);
  border_at(Part::kUpperArmR, Part::kForearmR, "elbow_r", 0.05);
  border_at(Part::kTorsoUL, Part::kUpperArmL, "shoulder_l", 0.09);
  border_at(Part::kTorsoLR, Part::kThighR, "hip_r", 0.14);
  border_at(Part::kHead, Part::kTorsoUL, "neck", 0.09);
}

TEST_CASE("the average body is its own mirror image") {
  const synth::Body body = made({.pose = Pose::kA, .vertices = 4000});
  std::vector<std::size_t> by_y(body.part.size());
  for (std::size_t v = 0; v < by_y.size(); ++v) by_y[v] = v;
  const auto& p = body.mesh.positions;
  std::sort(by_y.begin(), by_y.end(), [&](std::size_t a, std::size_t b) { return p[a].y() < p[b].y(); });
  for (std::size_t v = 0; v < p.size(); ++v) {
    const Vec3 mirrored(-p[v].x(), p[v].y(), p[v].z());
    double nearest = 1.0;
    auto from = std::lower_bound(by_y.begin(), by_y.end(), mirrored.y() - 1e-5,
                                 [&](std::size_t k, double y) { return p[k].y() < y; });
    for (; from != by_y.end() && p[*from].y() < mirrored.y() + 1e-5; ++from)
      nearest = std::min(nearest, (p[*from] - mirrored).norm());
    REQUIRE(nearest < 1e-5);
  }
}

TEST_CASE("the same options give the same bits for any number of workers") {
  const BodyOptions options{.pose = Pose::kRandom, .vertices = 5000, .seed = 11};
  const auto workers = bodice_test::make_threads(3);
  engine::Context parallel;
  parallel.executor = workers.get();
  const std::uint64_t serial = hash(made(options));
  CHECK(hash(made(options)) == serial);
  CHECK(hash(made(options, parallel)) == serial);
  CHECK(hash(made({.pose = Pose::kRandom, .vertices = 5000, .seed = 12})) != serial);
}

TEST_CASE("one body has the same shape at all resolutions") {
  const synth::Body coarse = made({.pose = Pose::kStride, .vertices = 3000, .seed = 5});
  const synth::Body fine = made({.pose = Pose::kStride, .vertices = 30000, .seed = 5});
  const geometry::MeshDistance skin({}, fine.mesh);
  double worst = 0.0;
  for (const Vec3& p : coarse.mesh.positions) worst = std::max(worst, std::abs(skin.signed_distance(p)));
  CHECK(worst < 0.008 * coarse.stature_m);
  for (int k = 0; k < body::kLandmarkCount; ++k)
    CHECK((coarse.landmarks[static_cast<std::size_t>(k)].position -
           fine.landmarks[static_cast<std::size_t>(k)].position)
              .norm() < 0.02 * coarse.stature_m);
}

TEST_CASE("random poses do not run limbs through the body") {
  // The winding number is one just under the skin, and two where flesh passes through flesh.
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    const synth::Body body = made({.pose = Pose::kRandom, .vertices = 2500, .seed = seed});
    const geometry::MeshDistance skin({}, body.mesh);
    const auto normals = geometry::vertex_normals(body.mesh);
    int doubled = 0;
    for (std::size_t v = 0; v < normals.size(); ++v)
      doubled += skin.winding_number(body.mesh.positions[v] - 0.003 * body.stature_m * normals[v]) > 1.5;
    CHECK(doubled < 0.06 * static_cast<double>(normals.size()));
  }
}

}  // namespace
