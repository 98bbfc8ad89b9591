// Cloth between two parts of a body that come together: an arm in a sleeve against a trunk in a shirt.
// Contact with the body has priority: layers that push each other apart must not go into it.
#include <doctest/doctest.h>

#include "layer_fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

constexpr double kTrunk_m = 0.12, kArm_m = 0.05, kEase_m = 0.003, kApart_m = 0.03;

/// The arm moves in by 30 mm and `in_m` more, and out again, within a second. The tubes begin at the height
/// `top_m`; their upper rims are pinned, that of the sleeve to the arm.
LayerScene arm_against_trunk(double in_m, double top_m, double length_m) {
  constexpr int kAroundTrunk = 40, kAroundArm = 20, kTubeRows = 12;
  const double arm_x = kTrunk_m + kApart_m + kArm_m;
  LayerScene scene;
  scene.body = {ellipsoid(Vec3(0, 1, 0), Vec3(kTrunk_m, 0.5, kTrunk_m)),
                ellipsoid(Vec3(arm_x, 1, 0), Vec3(kArm_m, 0.5, kArm_m))};
  const auto add_tube = [&](int columns, double x, double radius) {
    const auto first = static_cast<Index>(scene.mesh.positions.size());
    append(surface(columns, kTubeRows, true,
                   [&](double u, double v) {
                     return Vec3(around(u, radius + kEase_m, top_m - length_m * v) + Vec3(x, 0, 0));
                   }),
           scene.mesh);
    for (Index i = 0; i < static_cast<Index>(columns); ++i) scene.pins.push_back(first + i);
  };
  add_tube(kAroundTrunk, 0.0, kTrunk_m);
  add_tube(kAroundArm, arm_x, kArm_m);
  const auto moved = [in_m](double time_s) {
    const double turn = 2.0 * std::numbers::pi * std::min(1.0, time_s);
    return Vec3(-0.5 * (kApart_m + in_m) * (1.0 - std::cos(turn)), 0, 0);
  };
  scene.pin_at = [=](const Vec3& start, double time_s) {
    return start.x() > kTrunk_m + 0.5 * kApart_m ? Vec3(start + moved(time_s)) : start;
  };
  scene.move_body = [=](double time_s, std::vector<geometry::Ellipsoid>& body) {
    body.back().center = Vec3(arm_x, 1, 0) + moved(time_s);
  };
  scene.frames = 90;
  return scene;
}

// Cloth between two bodies that overlap by in_mm is at least half of that deep in one of them, unless it
// slips aside. Pinned rims move in with the arm, and cross while it is there, whatever the solver does. Other
// triangles cross as follows. Where there is room for cloth with a reduced thickness, at most kFew cross;
// with its full thickness, 51 to 115 would. Where the bodies overlap, 19 to 160 cross, depending on rounding.
// Half a second after the arm has gone, none crosses.
constexpr std::size_t kFew = 25;
constexpr double kHasRoom_mm = -0.5;
constexpr std::size_t kStarts = 5;

/// The median over several starts, which differ by rounding, of the most triangles that cross. Single runs
/// have 9 to 57, and two to four of ten have more than kFew.
std::size_t median_worst(const LayerScene& scene, std::size_t first) {
  std::vector<std::size_t> worst = {first};
  while (worst.size() < kStarts) {
    LayerScene other = scene;
    for (std::size_t v = 0; v < other.mesh.positions.size(); ++v)
      other.mesh.positions[v].y() += 1e-7 * static_cast<double>(worst.size() * ((7919 * v) % 13));
    worst.push_back(play(other, layered(true)).worst);
  }
  std::ranges::sort(worst);
  return worst[kStarts / 2];
}

void check_body_priority(double top_m, double length_m, bool rims_are_clear) {
  for (const double in_mm : {-2.0, -1.0, -0.5, 1.0, 4.0}) {
    CAPTURE(in_mm);
    const LayerScene scene = arm_against_trunk(1e-3 * in_mm, top_m, length_m);
    const LayerOutcome with = play(scene, layered(true)), without = play(scene, layered(false));
    CHECK(1e3 * with.deepest_m < std::max(1e3 * without.deepest_m, 0.5 * in_mm) + 0.5);
    if (rims_are_clear) CHECK(1e3 * with.deepest_m < 0.5 * std::max(0.0, in_mm) + 0.5);
    if (rims_are_clear && in_mm <= kHasRoom_mm) CHECK(median_worst(scene, with.worst) <= kFew);
    CHECK(without.worst > 2 * kFew);
    CHECK(with.start == 0);
    CHECK(with.end == 0);
    CHECK(with.report.layers.crossing == 0);
    CHECK(with.report.finite);
  }
}

}  // namespace

TEST_CASE(
    "pinch: between an arm and a trunk, layers go no deeper than without self-contact, and uncross after") {
  check_body_priority(1.1, 0.3, false);
}

TEST_CASE("pinch: the same holds for layers with pinned rims far from the contact") {
  check_body_priority(1.25, 0.5, true);
}

TEST_CASE("pinch: the same bits for any number of workers") {
  const LayerScene scene = arm_against_trunk(1e-3, 1.1, 0.3);
  const std::uint64_t hash = play(scene, layered(true), 1).hash;
  for (const int workers : {2, 3, 7}) CHECK(play(scene, layered(true), workers).hash == hash);
}
