// Pairs of parts that may touch: which are tested anew, and which are left out.
#include <doctest/doctest.h>

#include "layer_fixtures.hpp"
#include "selfcontact/contacts.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

constexpr float kGap_m = 1.5e-3f;

/// The strip of two leaves, and the group of both.
struct Strip {
  cloth::ContactMesh mesh;
  std::vector<cloth::Point> at;
  std::vector<cloth::PairTask> tasks;
  std::vector<cloth::LeafMove> moves;
  std::vector<float> deviation_m;
  std::vector<std::uint8_t> folded;
  cloth::Loose loose;

  explicit Strip(double angle) {
    const TriMesh strip = folded_strip(angle);
    mesh = cloth::make_contact_mesh(strip);
    REQUIRE(mesh.leaves() == 2);
    at = points_of(strip.positions);
    tasks.resize(1);
    tasks[0].groups.push_back(cloth::new_group(mesh, 0, 1, 0.0f));
    for (const std::size_t leaf : {0, 1}) moves.push_back(cloth::move_of(mesh, leaf, at, at));
    deviation_m.resize(2), folded.resize(2), loose = cloth::make_loose(at.size());
  }

  cloth::PairGroup& group() { return tasks[0].groups[0]; }
  void keep(float step_m) {
    // Quads are a quarter long, so that this gap makes pairs of neighbors.
    const cloth::ContactSource source{mesh, {0.25f, 0.1f, 0.0f, at, folded}, at, moves, deviation_m, loose};
    cloth::update_pairs(source, step_m, group(), tasks[0]);
  }
  bool has_pairs() { return group().end > group().begin; }
};

}  // namespace

TEST_CASE("pairs: parts that touched have a contact once they are apart, unless they coincide at rest") {
  const cloth::ContactMesh mesh;
  const std::vector<cloth::Point> apart = {{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, 1e-4f, -1, 1}, {0, 1e-4f, 1, 1}},
                                  touching = {{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, -1, 1}, {0, 0, 1, 1}};
  const auto source = [&](const std::vector<cloth::Point>& at, const std::vector<cloth::Point>& rest) {
    return cloth::ContactSource{mesh, {kGap_m, 0.0f, 0.0f, at, {}}, rest, {}, {}, {}};
  };
  cloth::Pair pair{.particle = {0, 1, 2, 3}, .edges = true};
  CHECK(cloth::contact_of(source(touching, apart), pair).gap_m == 0.0f);
  CHECK(cloth::contact_of(source(apart, apart), pair).gap_m == doctest::Approx(1e-4));
  cloth::Pair coincident{.particle = {0, 1, 2, 3}, .edges = true};
  CHECK(cloth::contact_of(source(touching, touching), coincident).gap_m == 0.0f);
  CHECK(cloth::contact_of(source(apart, touching), coincident).gap_m == 0.0f);
}

TEST_CASE("pairs: a flat patch has no pairs until it may have folded") {
  Strip strip(0.0);
  strip.keep(1e-3f);
  CHECK(strip.group().spared);
  CHECK_FALSE(strip.has_pairs());
  // A turn by 75 degrees takes a path of the triangles' height by its sine.
  CHECK(double{strip.group().complete_until_m} ==
        doctest::Approx(kStripHeight_m * std::sin(75.0 * std::numbers::pi / 180.0)).epsilon(1e-4));
}

TEST_CASE("pairs: a flat patch has pairs as soon as one beside it is folded") {
  Strip strip(0.0);
  strip.keep(1e-3f);
  REQUIRE(strip.group().spared);
  strip.folded[1] = 1;
  strip.keep(1e-3f);
  CHECK_FALSE(strip.group().spared);
  CHECK(strip.has_pairs());
}

TEST_CASE("pairs: at the end of a substep the leaves of a folded patch are marked, and no others") {
  for (const double degrees : {0.0, 150.0}) {
    CAPTURE(degrees);
    Strip strip(degrees * std::numbers::pi / 180.0);
    strip.folded = {1, 1};
    strip.keep(1e-3f);
    cloth::end_groups({}, strip.tasks, strip.folded);
    CHECK(strip.folded == std::vector<std::uint8_t>(2, degrees > 120.0));
  }
}

TEST_CASE(
    "pairs: leaves without a pair are tested again once they may be near, although their boxes overlap") {
  // Two triangles that lie over each other at 45 degrees, 6 mm apart.
  constexpr double kApart_m = 6e-3, kSide_m = 20e-3;
  const Vec3 along = Vec3(1, 1, 0).normalized(), across = Vec3(-1, 1, 0).normalized();
  TriMesh mesh;
  for (const double height_m : {0.0, kApart_m}) {
    const auto first = static_cast<Index>(mesh.positions.size());
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(kSide_m * along), Vec3(0, 0, kSide_m)})
      mesh.positions.push_back(corner + height_m * across);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const cloth::ContactMesh leaves = cloth::make_contact_mesh(mesh);
  REQUIRE(leaves.leaves() == 2);
  const std::vector<cloth::Point> at = points_of(mesh.positions);
  const std::vector<std::uint8_t> folded(2);
  constexpr float kSlack_m = 1.6e-3f;
  cloth::PairTask task;
  cloth::PairGroup group = cloth::new_group(leaves, 0, 1, 0.0f);
  cloth::find_pairs(leaves, {kGap_m, kSlack_m, 0.0f, at, folded}, group, task);
  CHECK(group.begin == group.end);
  CHECK(group.complete_until_m > kSlack_m);
  CHECK(double{group.complete_until_m} == doctest::Approx(kApart_m - double{kGap_m}).epsilon(1e-3));
}
