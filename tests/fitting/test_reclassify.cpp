// Eq. (8): a point that lies in several ellipsoids goes to the one with the nearest surface along its ray.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/fitting/mvee.hpp>

#include "cluster/cluster_items.hpp"
#include "radial_oracle.hpp"
#include "shapes.hpp"

using namespace bodice;
using fitting_test::holds;
using fitting_test::radial_distance_by_bisection;
using fitting_test::Skin;
using geometry::Index;
using geometry::Vec3;

namespace {

using Members = std::vector<std::vector<Index>>;

/// The vertices of one bent limb, with random ones of them as seeds.
struct Limb {
  Skin skin;
  fitting::Items items;
  fitting::Region region;

  Limb(int seeds, std::uint64_t trial) {
    const Skin all = fitting_test::bent_limbs();
    for (std::size_t v = 0; v < all.part.size(); ++v)
      if (all.part[v] == body::Part::kThighL) skin.mesh.positions.push_back(all.mesh.positions[v]);
    skin.part.assign(skin.mesh.positions.size(), body::Part::kThighL);
    skin.stature_m = all.stature_m;
    items = fitting::vertex_items(skin.view());
    region = fitting::make_regions(items, 1).front();
    region.seeds.clear();
    engine::Random random(trial);
    for (int s = 0; s < seeds; ++s)
      region.seeds.push_back(skin.mesh.positions[random.below(skin.mesh.positions.size())]);
  }
  std::vector<fitting::Cluster> clusters(bool reclassify) const {
    auto options = fitting::refine_options(skin.stature_m);
    options.reclassify = reclassify;
    const engine::Context context;
    fitting::Refinement refinement(context, items, region, options);
    refinement.run(0.0, region.seeds.size());
    return refinement.clusters();
  }
  /// Eq. (8) by brute force, over ellipsoids that are not changed meanwhile.
  Members by_equation_8(const std::vector<fitting::Cluster>& before) const {
    Members members(before.size());
    for (std::size_t k = 0; k < before.size(); ++k)
      for (const Index i : before[k].items) {
        const Vec3& p = skin.mesh.positions[i];
        std::size_t best = k;
        double least = radial_distance_by_bisection(before[k].ellipsoid, p);
        for (std::size_t j = 0; j < before.size(); ++j)
          if (j != k && holds(before[j].ellipsoid, p))
            if (const double d = radial_distance_by_bisection(before[j].ellipsoid, p); d < least)
              least = d, best = j;
        members[best].push_back(i);
      }
    for (auto& list : members) std::ranges::sort(list);
    return members;
  }
  /// The largest mean radial distance of clusters to the smallest ellipsoids that enclose them.
  double worst_error_m(const Members& members) const {
    double worst = 0.0;
    for (const auto& list : members) {
      std::vector<Vec3> points;
      for (const Index i : list) points.push_back(skin.mesh.positions[i]);
      const auto e = fitting::mvee(points).ellipsoid;
      double sum = 0.0;
      for (const Vec3& p : points) sum += radial_distance_by_bisection(e, p);
      worst = std::max(worst, sum / static_cast<double>(points.size()));
    }
    return worst;
  }
};

Members members_of(const std::vector<fitting::Cluster>& clusters) {
  Members members;
  for (const auto& c : clusters) members.push_back(c.items);
  return members;
}

}  // namespace

TEST_CASE(
    "reclassify: points move as eq. (8) has it where the worst error falls, and stay where it does not") {
  int moved = 0, stayed = 0;
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    const Limb limb(2 + static_cast<int>(trial % 7), trial);
    const auto before = limb.clusters(false), after = limb.clusters(true);
    const Members by_rule = limb.by_equation_8(before);
    if (by_rule == members_of(before)) continue;  // no point lies deeper in its own ellipsoid
    if (limb.worst_error_m(by_rule) < limb.worst_error_m(members_of(before))) {
      ++moved;
      CHECK(members_of(after) == by_rule);
    } else {
      ++stayed;
      CHECK(members_of(after) == members_of(before));
    }
    for (const auto& c : after)
      for (const Index i : c.items)
        CHECK(geometry::level(c.ellipsoid, limb.skin.mesh.positions[i]) <= 1 + 1e-9);
  }
  CHECK(moved > 0);
  CHECK(stayed > 0);
}

TEST_CASE("reclassify: the option of a fit lowers cluster errors of this body, and vertices stay inside" *
          doctest::test_suite("long")) {
  const Skin skin = fitting_test::bent_limbs();
  int lower = 0;
  for (const int count : {6, 9, 12, 15, 18, 21, 24, 30}) {
    CAPTURE(count);
    fitting::FitOptions options{.tier = proxy::Tier::kPaper, .max_ellipsoids = count};
    const auto without = fitting::fit({}, skin.view(), options);
    options.reclassify_points = true;
    const auto with = fitting::fit({}, skin.view(), options);
    REQUIRE((without.ok() && with.ok()));
    const auto worst_m = [](const fitting::FitResult& r) { return std::max(r.mu_torso_m, r.mu_limbs_m); };
    const auto mean_m = [](const fitting::FitResult& r) {
      double sum = 0.0;
      for (const auto& part : r.parts) sum += part.cluster_error->mean_m;
      return sum;
    };
    CHECK(worst_m(*with) <= worst_m(*without));
    CHECK(mean_m(*with) <= mean_m(*without));
    lower += worst_m(*with) < worst_m(*without);
    for (const Vec3& p : skin.mesh.positions)
      CHECK(std::ranges::any_of(with->proxy.ellipsoids(),
                                [&](const auto& e) { return geometry::level(e.shape, p) <= 1 + 1e-9; }));
  }
  CHECK(lower >= 2);
}
