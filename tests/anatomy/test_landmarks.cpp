// Landmarks that were once found wrong in some pose or on some build.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "analyzed.hpp"
#include "made.hpp"

namespace {

using namespace bodice;
using body::LandmarkId;
using body::Sex;
using geometry::Vec3;
using synth::Pose;

bool warns(const anatomy::Anatomy& found, const std::string& code, const std::string& part) {
  return std::any_of(found.warnings.begin(), found.warnings.end(),
                     [&](const engine::Warning& w) { return w.code == code && w.part == part; });
}

Vec3 position(const synth::Body& body, LandmarkId id) {
  return body.landmarks[static_cast<std::size_t>(id)].position;
}

/// A seat drawn out behind both thighs, so that the fold below it is deep. The truth stays.
void draw_out_seat(synth::Body& body) {
  constexpr double kFar = 0.08, kWide = 0.04;  // of the stature
  const Vec3 perineum = position(body, LandmarkId::kPerineum);
  const Vec3 up = (position(body, LandmarkId::kNeck) - perineum).normalized();
  const Vec3 across = position(body, LandmarkId::kArmpitL) - position(body, LandmarkId::kArmpitR);
  const Vec3 left = (across - across.dot(up) * up).normalized(), forward = left.cross(up);
  const Vec3 drawn = kFar * body.stature_m * (-forward - 0.3 * up).normalized();
  for (Vec3& p : body.mesh.positions)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 half = perineum + body.stature_m * (0.05 * side * left + 0.02 * up - 0.10 * forward);
      const double off = (p - half).norm() / (kWide * body.stature_m);
      p += std::exp(-0.5 * off * off) * drawn;
    }
}

synth::Body heavy_in_any_pose(std::uint64_t seed, double bmi, Sex sex) {
  constexpr double kStature_m = 1.7;
  auto body = synth::make_body({}, {.sex = sex,
                                    .stature_m = kStature_m,
                                    .mass_kg = bmi * kStature_m * kStature_m,
                                    .pose = Pose::kRandom,
                                    .vertices = 4000,
                                    .seed = seed});
  REQUIRE(body.ok());
  return std::move(*body);
}

}  // namespace

TEST_CASE("legs that are drawn up alone do not take a heavy body's perineum along") {
  constexpr int kBodies = 16;
  double sum = 0.0;
  for (int seed = 1; seed <= kBodies; ++seed) {
    const auto truth =
        heavy_in_any_pose(static_cast<std::uint64_t>(seed), 42.0, seed % 2 ? Sex::kFemale : Sex::kMale);
    const double error = made::error(truth, analyzed(truth.mesh), LandmarkId::kPerineum);
    CHECK(error < 0.04);
    sum += error;
  }
  CHECK(sum / kBodies < 0.0145);  // .0129; .0168 by the line between the legs alone
}

TEST_CASE("the fold below a heavy seat is not taken for the perineum in front of it") {
  for (const Sex sex : {Sex::kMale, Sex::kFemale}) {
    auto truth = heavy_in_any_pose(2, 46.0, sex);
    draw_out_seat(truth);
    CHECK(made::error(truth, analyzed(truth.mesh), LandmarkId::kPerineum) < 0.04);  // .061 in the fold
  }
}

TEST_CASE("heavy thighs and seats: the perineum is where the floor of the trunk turns up to the front") {
  const synth::BodyOptions bodies[] = {{.sex = Sex::kFemale,
                                        .stature_m = 1.538,
                                        .mass_kg = 79.8,
                                        .pose = Pose::kA,
                                        .vertices = 4881,
                                        .seed = 305},
                                       {.sex = Sex::kFemale,
                                        .stature_m = 1.697,
                                        .mass_kg = 84.5,
                                        .pose = Pose::kT,
                                        .vertices = 4780,
                                        .seed = 392},
                                       {.sex = Sex::kMale,
                                        .stature_m = 1.506,
                                        .mass_kg = 73.5,
                                        .pose = Pose::kT,
                                        .vertices = 3930,
                                        .seed = 7096},
                                       {.sex = Sex::kMale,
                                        .stature_m = 1.727,
                                        .mass_kg = 111.9,
                                        .pose = Pose::kA,
                                        .vertices = 4454,
                                        .seed = 20113},
                                       {.sex = Sex::kFemale,
                                        .stature_m = 1.701,
                                        .mass_kg = 107.5,
                                        .pose = Pose::kA,
                                        .vertices = 6237,
                                        .seed = 20350},
                                       {.sex = Sex::kFemale,
                                        .stature_m = 1.657,
                                        .mass_kg = 89.3,
                                        .pose = Pose::kT,
                                        .vertices = 13100,
                                        .seed = 7099,
                                        .pregnant = true}};
  for (const synth::BodyOptions& options : bodies) {
    CAPTURE(options.seed);
    const auto truth = synth::make_body({}, options);
    REQUIRE(truth.ok());
    CHECK(made::error(*truth, analyzed(truth->mesh), LandmarkId::kPerineum) < 0.025);
  }
}

TEST_CASE("a hand held over the head takes no part in the crown") {
  for (const synth::BodyOptions& options : {
           synth::BodyOptions{.sex = Sex::kFemale,
          .stature_m = 1.8312007934053538,
          .mass_kg = 96.08109382409441,
          .pose = Pose::kRandom,
          .vertices = 3345,
          .seed = 40237},
           synth::BodyOptions{.sex = Sex::kFemale,
           .stature_m = 1.8085147421205749,
           .mass_kg = 84.7338193872279,
           .pose = Pose::kRandom,
           .vertices = 9044,
           .seed = 40194},
       }) {
    CAPTURE(options.seed);
    const auto truth = synth::make_body({}, options);
    REQUIRE(truth.ok());
    CHECK(made::error(*truth, analyzed(truth->mesh), LandmarkId::kCrown) < 0.025);
  }
}

TEST_CASE("an elbow that is raised beside a heavy neck is not the head") {
  // Within the head's reach and farther from the feet than the crown, it was taken for the head.
  const synth::BodyOptions bodies[] = {{.sex = Sex::kMale,
                                        .stature_m = 1.5120383369533883,
                                        .mass_kg = 90.768976125488038,
                                        .pose = Pose::kRandom,
                                        .vertices = 6061,
                                        .seed = 700196},
                                       {.sex = Sex::kMale,
                                        .stature_m = 1.7349963962671398,
                                        .mass_kg = 122.76968423894155,
                                        .pose = Pose::kRandom,
                                        .vertices = 2614,
                                        .seed = 900428}};
  for (const synth::BodyOptions& options : bodies) {
    CAPTURE(options.seed);
    const auto truth = synth::make_body({}, options);
    REQUIRE(truth.ok());
    const auto found = analyzed(truth->mesh);
    CHECK(made::error(*truth, found, LandmarkId::kCrown) < 0.04);
    CHECK(made::error(*truth, found, LandmarkId::kNeck) < 0.04);
    CHECK(made::agreement(*truth, found.part) > 0.95);
  }
}

TEST_CASE("an armpit that another vertex nearly equals is right, or doubted in a warning") {
  const auto truth = synth::make_body({}, {.sex = Sex::kFemale,
                                           .stature_m = 0.87621975075750458,
                                           .mass_kg = 16.493497289413895,
                                           .pose = Pose::kRandom,
                                           .vertices = 6331,
                                           .seed = 229,
                                           .childhood = 0.97649311484419643});
  REQUIRE(truth.ok());
  const anatomy::Anatomy found = analyzed(truth->mesh);
  CHECK((made::error(*truth, found, LandmarkId::kArmpitL) < 0.04 ||
         warns(found, "armpit-uncertain", "upper_arm_l")));
  CHECK((made::error(*truth, found, LandmarkId::kArmpitR) < 0.04 ||
         warns(found, "armpit-uncertain", "upper_arm_r")));
}

TEST_CASE("arms that hang or rise on a heavy or a small body are no reason to doubt an elbow") {
  for (const Pose pose : {Pose::kArmsDown, Pose::kArmsUp, Pose::kHandstand}) {
    CAPTURE(static_cast<int>(pose));
    for (const std::uint64_t seed : {60U, 181U, 447U, 20367U}) {
      CAPTURE(seed);
      const auto truth =
          synth::make_body({}, {.mass_kg = 36.0 * 1.68 * 1.68, .pose = pose, .vertices = 5000, .seed = seed});
      REQUIRE(truth.ok());
      const anatomy::Anatomy found = analyzed(truth->mesh);
      for (const auto& [elbow, part] :
           {std::pair{LandmarkId::kElbowL, "upper_arm_l"}, std::pair{LandmarkId::kElbowR, "upper_arm_r"}}) {
        CHECK(made::error(*truth, found, elbow) < 0.025);
        CHECK(!warns(found, "elbow-disagrees", part));
      }
    }
  }
}

TEST_CASE("borders follow the build: the parts of very heavy bodies are right") {
  // Borders that were one sum of distances for all builds left 7.2 and 9.1 % of their skin in other parts; on
  // the second, half of the seat was cut off from the rest of its part and went to the thigh.
  const synth::BodyOptions bodies[] = {{.sex = Sex::kFemale,
                                        .stature_m = 1.4548557658593992,
                                        .mass_kg = 83.532212619007637,
                                        .pose = Pose::kSit,
                                        .vertices = 6052,
                                        .seed = 800352,
                                        .pregnant = true},
                                       {.sex = Sex::kMale,
                                        .stature_m = 1.4858854474704632,
                                        .mass_kg = 89.802826152959014,
                                        .pose = Pose::kRandom,
                                        .vertices = 2985,
                                        .seed = 329}};
  for (const synth::BodyOptions& options : bodies) {
    CAPTURE(options.seed);
    const auto truth = synth::make_body({}, options);
    REQUIRE(truth.ok());
    CHECK(made::agreement(*truth, analyzed(truth->mesh).part) > 0.94);
  }
}

TEST_CASE("a leg that is kicked forward leaves its seat to its own side") {
  // By distances from the feet alone, .36 % of the limbs' skin lay on the other side: the seat behind the
  // raised leg is nearer to the foot of the standing one.
  const synth::BodyOptions options{.sex = Sex::kFemale,
                                   .stature_m = 1.9118931783378028,
                                   .mass_kg = 122.89318118329113,
                                   .pose = Pose::kKick,
                                   .vertices = 3261,
                                   .seed = 950155,
                                   .pregnant = true};
  const auto truth = synth::make_body({}, options);
  REQUIRE(truth.ok());
  CHECK(made::swapped(*truth, analyzed(truth->mesh).part) == 0.0);
}
