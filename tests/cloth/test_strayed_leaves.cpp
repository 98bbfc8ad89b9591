// Groups of leaves with particles that left their expected paths.
#include <doctest/doctest.h>

#include <set>

#include "layer_fixtures.hpp"
#include "selfcontact/expected_paths.hpp"
#include "selfcontact/self_contact.hpp"
#include "selfcontact/strayed_leaves.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

constexpr int kCellsASide = 40;
constexpr double kCell_m = 10e-3, kLayerGap_m = 3e-3, kBetween_m = 30e-3;
constexpr float kSubstep_s = 1.0f / 480.0f;

using LeafPair = std::pair<std::uint32_t, std::uint32_t>;

/// Two sheets over each other at rest, after a search for pairs.
struct TwoSheets {
  TriMesh mesh;
  cloth::Particles particles;
  std::vector<std::uint8_t> touching;
  cloth::SelfContact self;

  explicit TwoSheets(double between_m = kBetween_m) {
    const double side_m = kCellsASide * kCell_m;
    for (const double height_m : {0.0, between_m})
      append(surface(kCellsASide, kCellsASide, false,
                     [&](double u, double v) { return Vec3(u * side_m, height_m, v * side_m); }),
             mesh);
    particles = cloth::make_particles(mesh, 0.1, std::vector<bool>(mesh.positions.size(), false));
    for (std::size_t i = 0; i < particles.count(); ++i)
      particles.point[i] = {particles.x[i], particles.y[i], particles.z[i], particles.inverse_mass[i]};
    touching.assign(particles.count(), 0);
    self = cloth::make_self_contact(mesh, particles, kLayerGap_m, kCell_m);
    cloth::begin_self_contact({}, particles, self);
    push_apart();
  }

  void push_apart() {
    cloth::push_apart({}, {.length_s = kSubstep_s, .frame_s = 8 * kSubstep_s, .touching = touching}, self,
                      particles);
  }

  /// The particle of the lower sheet in this row and column, and the one of the upper sheet over it.
  Index at(int row, int column) const { return static_cast<Index>(row * (kCellsASide + 1) + column); }
  Index above(Index i) const { return i + static_cast<Index>(particles.count() / 2); }
  /// Lifts a particle of the lower sheet in this substep.
  void lift(Index i, double by_m) { self.now[i].y += static_cast<float>(by_m); }
  /// Lists the groups of particles that deviate by more than half of the spare distance.
  bool list() {
    const float most_m = 0.499f * self.spare_m;
    cloth::measure_deviations({}, self.now, kSubstep_s, most_m, self);
    return cloth::list_groups_of_strayed(kSubstep_s, most_m, self);
  }

  std::set<LeafPair> listed() const {
    std::set<LeafPair> all;
    for (const cloth::PairTask& task : self.tasks) {
      for (const cloth::PairGroup& group : task.groups) all.emplace(group.leaf[0], group.leaf[1]);
      for (const cloth::ClearGroup& group : task.clear) all.emplace(group.leaf[0], group.leaf[1]);
    }
    return all;
  }
  /// The groups that are not clear.
  std::set<LeafPair> awake() const {
    std::set<LeafPair> all;
    for (const cloth::PairTask& task : self.tasks)
      for (const cloth::PairGroup& group : task.groups) all.emplace(group.leaf[0], group.leaf[1]);
    return all;
  }
  /// The pairs of leaves with particles nearer to each other than the gap, by comparing all particles.
  std::set<LeafPair> near() const {
    std::set<LeafPair> all;
    for (std::uint32_t a = 0; a < self.mesh.leaves(); ++a)
      for (std::uint32_t b = a; b < self.mesh.leaves(); ++b)
        if (touch(a, b)) all.emplace(a, b);
    return all;
  }

 private:
  bool touch(std::uint32_t a, std::uint32_t b) const {
    for (const Index i : self.mesh.particles_of(a))
      for (const Index j : self.mesh.particles_of(b)) {
        const cloth::Point &p = self.now[i], &q = self.now[j];
        if (std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) < self.gap_m) return true;
      }
    return false;
  }
};

}  // namespace

TEST_CASE("strayed leaves: a particle that strays to another layer gets groups with it; all others stay") {
  TwoSheets sheets;
  const std::set<LeafPair> before = sheets.listed();
  for (const auto& [row, column] : {std::pair(3, 5), std::pair(20, 20), std::pair(20, 21), std::pair(39, 0)})
    sheets.lift(sheets.at(row, column), kBetween_m - 1e-3);
  CHECK_FALSE(std::ranges::includes(before, sheets.near()));
  REQUIRE(sheets.list());
  const std::set<LeafPair> after = sheets.listed();
  CHECK(std::ranges::includes(after, sheets.near()));
  CHECK(std::ranges::includes(after, before));
  CHECK(after.size() < before.size() + before.size() / 10);  // no group is added near other particles
  for (const cloth::PairTask& task : sheets.self.tasks)
    for (std::size_t g = 1; g < task.groups.size(); ++g) {
      const cloth::PairGroup &a = task.groups[g - 1], &b = task.groups[g];
      CHECK(LeafPair(a.leaf[0], a.leaf[1]) < LeafPair(b.leaf[0], b.leaf[1]));
    }
}

TEST_CASE("strayed leaves: a particle may stray as far again without a new list, and not farther") {
  TwoSheets sheets;
  const Index i = sheets.at(7, 7);
  sheets.lift(i, 12e-3);
  REQUIRE(sheets.list());
  const std::size_t listed = sheets.self.strayed.listed;
  REQUIRE(sheets.list());
  CHECK(sheets.self.strayed.particles.empty());
  CHECK(sheets.self.strayed.listed == listed);
  sheets.lift(i, kBetween_m - 13e-3);
  REQUIRE(sheets.list());
  CHECK(sheets.self.strayed.particles == std::vector<Index>{i});
  CHECK(std::ranges::includes(sheets.listed(), sheets.near()));
}

TEST_CASE("strayed leaves: many particles, a very far one, or a tree of other sweeps need a new search") {
  TwoSheets many;
  for (int column = 0; column <= kCellsASide; ++column) many.lift(many.at(9, column), 12e-3);
  CHECK_FALSE(many.list());
  TwoSheets far;
  far.lift(far.at(2, 2), 1.0);
  CHECK_FALSE(far.list());
  TwoSheets other;
  other.self.tree_has_sweeps = false;
  other.lift(other.at(2, 2), 12e-3);
  CHECK_FALSE(other.list());
}

TEST_CASE("strayed leaves: leaves that stay apart on expected paths have no pairs until they come near") {
  TwoSheets sheets(10.2e-3);
  const std::set<LeafPair> before = sheets.awake();
  CHECK(before.size() < sheets.listed().size());  // the sheets are in reach of each other
  CHECK(std::ranges::includes(before, sheets.near()));
  // Each particle deviates by less than is allowed, but together they come nearer than the gap.
  const Index lower = sheets.at(20, 20), upper = sheets.above(lower);
  sheets.particles.point[lower].y += 3.9e-3f, sheets.particles.point[upper].y -= 3.9e-3f;
  sheets.push_apart();
  CHECK(sheets.self.strayed.listed == 0);
  const std::set<LeafPair> near = sheets.near(), after = sheets.awake();
  CHECK_FALSE(std::ranges::includes(before, near));
  CHECK(std::ranges::includes(after, near));
  CHECK(after.size() < before.size() + 30);  // all else is clear as before
  // They are pushed apart in the substep that brings them together.
  CHECK(sheets.particles.point[upper].y - sheets.particles.point[lower].y > 0.99f * sheets.self.gap_m);
}
