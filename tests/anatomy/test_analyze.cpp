#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <bodice_test/executors.hpp>

#include "made.hpp"

using namespace bodice;
using body::LandmarkId;

namespace {

engine::Result<anatomy::Anatomy> analyze(const geometry::TriMesh& mesh, const engine::Context& context = {}) {
  return anatomy::analyze(context, mesh, {*body::find_profile("ansur2")});
}

/// Worst distance between the landmarks of two answers, after `back` undoes what was done to the second mesh.
template <class Back>
double worst_move(const anatomy::Anatomy& a, const anatomy::Anatomy& b, Back back) {
  double worst = 0.0;
  for (int i = 0; i < body::kLandmarkCount; ++i)
    worst = std::max(worst, (a.landmarks[i].position - back(b.landmarks[i].position)).norm() / a.stature_m);
  return worst;
}

}  // namespace

TEST_CASE("fifty random bodies in random poses: parts agree, sides are never swapped, landmarks are near") {
  double sum = 0.0, chest_sum = 0.0;
  int far = 0;
  constexpr int kSeeds = 50;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    CAPTURE(seed);
    const synth::Body truth = made::random_body(seed);
    const auto found = analyze(truth.mesh);
    REQUIRE_MESSAGE(found.ok(), (found.ok() ? "" : found.error().sentence()));
    const double agreement = made::agreement(truth, found->part);
    sum += agreement;
    chest_sum += made::chest_agreement(truth, found->part);
    CHECK(agreement > 0.90);
    CHECK(made::swapped(truth, found->part) < 0.01);
    for (int i = 0; i < body::kLandmarkCount; ++i) {
      CAPTURE(std::string(body::kLandmarkNames[i]));
      const double error = made::error(truth, *found, static_cast<LandmarkId>(i));
      CHECK(error < 0.06);
      far += error > 0.04;
    }
    CHECK(found->stature_m == doctest::Approx(truth.stature_m).epsilon(0.06));
  }
  CHECK(sum / kSeeds > 0.965);
  CHECK(chest_sum / kSeeds > 0.9);
  CHECK(far < kSeeds * body::kLandmarkCount / 50);
}

TEST_CASE("children of all ages, pregnant and very heavy bodies are understood") {
  const auto check = [](const synth::BodyOptions& options) {
    const auto truth = synth::make_body({}, options);
    REQUIRE(truth.ok());
    const auto found = analyze(truth->mesh);
    REQUIRE(found.ok());
    CHECK(made::agreement(*truth, found->part) > 0.93);
    CHECK(made::swapped(*truth, found->part) < 0.001);
    for (int i = 0; i < body::kLandmarkCount; ++i) {
      CAPTURE(std::string(body::kLandmarkNames[i]));
      CHECK(made::error(*truth, *found, static_cast<LandmarkId>(i)) < 0.05);
    }
  };
  for (const synth::Pose pose : {synth::Pose::kA, synth::Pose::kRun}) {
    CAPTURE(static_cast<int>(pose));
    for (const double childhood : {0.3, 0.6, 1.0}) {
      CAPTURE(childhood);
      const double stature = 1.55 - 0.69 * childhood;
      check({.stature_m = stature,
             .mass_kg = 17.0 * stature * stature,
             .pose = pose,
             .vertices = 5000,
             .seed = 9,
             .childhood = childhood});
    }
    check({.pose = pose, .vertices = 5000, .seed = 4, .pregnant = true});
    check({.mass_kg = 41.0 * 1.68 * 1.68, .pose = pose, .vertices = 5000, .seed = 2});
  }
}

TEST_CASE(
    "very heavy bodies with arms spread: the armpit is the crease under the arm, not the back above it") {
  for (const std::uint64_t seed : {2U, 14U, 20U, 161U, 364U}) {
    CAPTURE(seed);
    const auto truth = synth::make_body(
        {}, {.mass_kg = 40.0 * 1.68 * 1.68, .pose = synth::Pose::kT, .vertices = 5000, .seed = seed});
    REQUIRE(truth.ok());
    const auto found = analyze(truth->mesh);
    REQUIRE(found.ok());
    for (const LandmarkId armpit : {LandmarkId::kArmpitL, LandmarkId::kArmpitR})
      CHECK(made::error(*truth, *found, armpit) < 0.025);
  }
}

namespace {

double worst_error(const synth::Body& truth, std::initializer_list<LandmarkId> ids) {
  const auto found = analyze(truth.mesh);
  REQUIRE(found.ok());
  double worst = 0.0;
  for (const LandmarkId id : ids) worst = std::max(worst, made::error(truth, *found, id));
  return worst;
}

/// The body with its head bent back about the joint of the neck, and its crown with it.
synth::Body looking_up(const synth::BodyOptions& options) {
  synth::Body body = synth::make_body({}, options).value();
  constexpr double kAngle_rad = -35.0 * M_PI / 180.0, kNeckLength = 0.09, kNeckWidth = 0.16;
  const geometry::Vec3 neck = body.landmarks[static_cast<std::size_t>(LandmarkId::kNeck)].position;
  const auto bent = [&](const geometry::Vec3& p) {
    const geometry::Vec3 q = p - neck;
    const double t = std::clamp(q.y() / (kNeckLength * body.stature_m), 0.0, 1.0);
    const double share =
        std::hypot(q.x(), q.z()) > kNeckWidth * body.stature_m ? 0.0 : t * t * (3.0 - 2.0 * t);
    const double c = std::cos(share * kAngle_rad), s = std::sin(share * kAngle_rad);
    return geometry::Vec3(neck + geometry::Vec3(q.x(), c * q.y() - s * q.z(), s * q.y() + c * q.z()));
  };
  for (std::size_t v = 0; v < body.part.size(); ++v)
    if (body.part[v] < body::Part::kUpperArmL) body.mesh.positions[v] = bent(body.mesh.positions[v]);
  auto& crown = body.landmarks[static_cast<std::size_t>(LandmarkId::kCrown)].position;
  crown = bent(crown);
  return body;
}

synth::BodyOptions child_of_two(synth::Pose pose) {
  return {.stature_m = 0.86,
          .mass_kg = 17.0 * 0.86 * 0.86,
          .pose = pose,
          .vertices = 5000,
          .seed = 9,
          .childhood = 1.0};
}

synth::BodyOptions very_heavy(synth::Pose pose) {
  return {.mass_kg = 41.0 * 1.68 * 1.68, .pose = pose, .vertices = 5000, .seed = 14};
}

}  // namespace

TEST_CASE(
    "the crown of a head that is bent back is its top, although the folds of the nape shorten the path") {
  for (const auto& options : {child_of_two(synth::Pose::kArmsUp), very_heavy(synth::Pose::kArmsUp)})
    CHECK(worst_error(looking_up(options), {LandmarkId::kCrown}) < 0.028);
}

TEST_CASE("elbows and knees are where the bones turn, not where the borders' loops have their middle") {
  const synth::BodyOptions adult{
      .mass_kg = 24.0 * 1.68 * 1.68, .pose = synth::Pose::kT, .vertices = 5000, .seed = 5};
  for (const auto& options : {child_of_two(synth::Pose::kT), very_heavy(synth::Pose::kT), adult}) {
    const synth::Body truth = synth::make_body({}, options).value();
    CHECK(worst_error(truth, {LandmarkId::kElbowL, LandmarkId::kElbowR}) < 0.015);
    CHECK(worst_error(truth, {LandmarkId::kKneeL, LandmarkId::kKneeR}) < 0.012);
  }
}

TEST_CASE("the neck's joint is found on a body in a random pose on which the border's loop lies off it") {
  const synth::Body truth =
      synth::make_body(
          {},
          {.stature_m = 1.685, .mass_kg = 60.9, .pose = synth::Pose::kRandom, .vertices = 11903, .seed = 478})
          .value();
  CHECK(worst_error(truth, {LandmarkId::kNeck}) < 0.035);
}

TEST_CASE("the tips of blunt feet are where they are found") {
  for (const auto& [stature_m, mass_kg, seed] : {std::tuple{1.942, 108.3, 147U}, {1.798, 90.2, 160U}}) {
    const synth::Body truth = synth::make_body({}, {.sex = body::Sex::kMale,
                                                    .stature_m = stature_m,
                                                    .mass_kg = mass_kg,
                                                    .pose = synth::Pose::kA,
                                                    .vertices = 10500,
                                                    .seed = seed})
                                  .value();
    CHECK(worst_error(truth, {LandmarkId::kToeL, LandmarkId::kToeR}) < 0.025);
  }
}

TEST_CASE("every landmark has a confidence that was measured") {
  const synth::Body truth = made::random_body(6);
  const auto found = analyze(truth.mesh);
  REQUIRE(found.ok());
  for (const body::Landmark& mark : found->landmarks) {
    CAPTURE(std::string(body::name(mark.id)));
    CHECK(mark.confidence > 0.0);
    CHECK(mark.confidence <= 1.0);
  }
  CHECK(std::any_of(found->landmarks.begin(), found->landmarks.end(),
                    [](const body::Landmark& m) { return m.confidence < 0.999; }));
}

TEST_CASE("left and right hold on bent knees of any build, where paths run over the back of the leg") {
  for (const synth::Pose pose : {synth::Pose::kRun, synth::Pose::kSquat, synth::Pose::kSit})
    for (const double bmi : {18.0, 30.0, 40.0})
      for (const int vertices : {1700, 3600}) {
        CAPTURE(static_cast<int>(pose));
        CAPTURE(bmi);
        CAPTURE(vertices);
        synth::BodyOptions options;
        options.pose = pose;
        options.mass_kg = bmi * options.stature_m * options.stature_m;
        options.vertices = vertices;
        options.seed = 3;
        const auto truth = synth::make_body({}, options);
        REQUIRE(truth.ok());
        const auto found = analyze(truth->mesh);
        REQUIRE(found.ok());
        CHECK(made::swapped(*truth, found->part) < 0.001);
      }
}

TEST_CASE("fins that bridge the body change nothing") {
  synth::BodyOptions options;
  options.vertices = 3600;
  const auto body = synth::make_body({}, options);
  REQUIRE(body.ok());
  const auto reference = analyze(body->mesh);
  REQUIRE(reference.ok());
  geometry::TriMesh finned = body->mesh;
  const auto crown = reference->landmarks[static_cast<std::size_t>(LandmarkId::kCrown)].vertex;
  for (std::size_t f = 0; f < body->mesh.triangles.size(); f += 97)
    finned.triangles.push_back({body->mesh.triangles[f][0], body->mesh.triangles[f][1], crown});
  const auto found = analyze(finned);
  REQUIRE(found.ok());
  CHECK(found->part == reference->part);
  CHECK(worst_move(*reference, *found, [](const geometry::Vec3& p) { return p; }) < 1e-9);
}

TEST_CASE("a forearm welded to the trunk in one vertex is taken apart with a warning") {
  synth::BodyOptions options;
  options.vertices = 5000;
  options.pose = synth::Pose::kArmsDown;
  const auto body = synth::make_body({}, options);
  REQUIRE(body.ok());
  const auto reference = analyze(body->mesh);
  REQUIRE(reference.ok());
  geometry::Index arm = 0, other = 0;
  double least = 1e9;
  for (geometry::Index v = 0; v < body->part.size(); ++v)
    for (geometry::Index w = 0; w < body->part.size() && body->part[v] == body::Part::kForearmL; ++w) {
      const bool apart = body->part[w] == body::Part::kThighL || body->part[w] == body::Part::kTorsoLL;
      const double d = (body->mesh.positions[v] - body->mesh.positions[w]).norm();
      if (apart && d < least) {
        least = d;
        arm = v;
        other = w;
      }
    }
  geometry::TriMesh welded = body->mesh;
  for (auto& t : welded.triangles)
    for (auto& v : t)
      if (v == arm) v = other;
  const auto found = analyze(welded);
  REQUIRE(found.ok());
  std::size_t differ = 0;
  for (std::size_t v = 0; v < found->part.size(); ++v)
    differ += v != arm && found->part[v] != reference->part[v];
  CHECK(differ < found->part.size() / 100);
  CHECK(std::any_of(found->warnings.begin(), found->warnings.end(),
                    [](const engine::Warning& w) { return w.code == "skin-touches"; }));
}

TEST_CASE("any number of workers gives the same bits") {
  const synth::Body truth = made::random_body(5);
  const auto serial = analyze(truth.mesh);
  REQUIRE(serial.ok());
  for (const int workers : {2, 4}) {
    const auto executor = bodice_test::make_threads(workers);
    engine::Context context;
    context.executor = executor.get();
    const auto parallel = analyze(truth.mesh, context);
    REQUIRE(parallel.ok());
    CHECK(parallel->part == serial->part);
    CHECK(parallel->stature_m == serial->stature_m);
    CHECK(worst_move(*serial, *parallel, [](const geometry::Vec3& p) { return p; }) == 0.0);
  }
}

TEST_CASE("a mirrored body's left is the original's right") {
  const synth::Body truth = made::random_body(8);
  geometry::TriMesh mirror = truth.mesh;
  for (auto& p : mirror.positions) p.x() = -p.x();
  for (auto& t : mirror.triangles) std::swap(t[1], t[2]);
  const auto a = analyze(truth.mesh), b = analyze(mirror);
  REQUIRE((a.ok() && b.ok()));
  std::size_t differ = 0;
  for (std::size_t v = 0; v < a->part.size(); ++v) differ += body::mirrored(a->part[v]) != b->part[v];
  CHECK(differ < a->part.size() / 50);  // on a symmetric body the perineum is one of two mirrored vertices
}

TEST_CASE("each part is one patch of the skin") {
  const synth::Body truth = made::random_body(2);
  const auto found = analyze(truth.mesh);
  REQUIRE(found.ok());
  std::array<int, body::kPartCount> patches{};
  std::vector<char> seen(found->part.size(), 0);
  std::vector<std::vector<geometry::Index>> next(found->part.size());
  for (const auto& t : truth.mesh.triangles)
    for (int k = 0; k < 3; ++k) next[t[k]].push_back(t[(k + 1) % 3]);
  for (geometry::Index v = 0; v < seen.size(); ++v) {
    if (seen[v]) continue;
    ++patches[static_cast<int>(found->part[v])];
    std::vector<geometry::Index> stack{v};
    seen[v] = 1;
    while (!stack.empty()) {
      const geometry::Index at = stack.back();
      stack.pop_back();
      for (const geometry::Index w : next[at])
        if (!seen[w] && found->part[w] == found->part[at]) {
          seen[w] = 1;
          stack.push_back(w);
        }
    }
  }
  for (const int count : patches) CHECK(count == 1);
}

TEST_CASE("what is not a body fails with a sentence, and never crashes") {
  geometry::TriMesh mesh;
  CHECK(analyze(mesh).error().code == engine::ErrorCode::kUnusableGeometry);
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  CHECK(!analyze(mesh).ok());
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};  // a tetrahedron
  const auto found = analyze(mesh);
  REQUIRE(!found.ok());
  CHECK(found.error().code == engine::ErrorCode::kUnusableGeometry);
  CHECK(!found.error().remedy.empty());
}
