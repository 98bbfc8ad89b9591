// The reported E_j against a recomputation that shares no formula with the fit: the surface point on each ray
// is found by bisection.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <bodice/fitting/fit.hpp>

#include "cluster/allocate_ellipsoids.hpp"
#include "cluster/cluster_items.hpp"
#include "radial_oracle.hpp"
#include "shapes.hpp"

using namespace bodice;
using fitting::FitOptions;
using fitting_test::bent_limbs;
using fitting_test::radial_distance_by_bisection;
using fitting_test::Skin;
using geometry::Vec3;
using proxy::Tier;

namespace {

FitOptions paper(int count) {
  return {.tier = Tier::kPaper, .max_ellipsoids = count};
}

double mean_radial_distance(const geometry::Ellipsoid& e, const std::vector<Vec3>& points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += radial_distance_by_bisection(e, p);
  return sum / static_cast<double>(points.size());
}

/// The clusters' errors by part, from the same splits as the fit's.
std::array<std::vector<double>, body::kPartCount> recomputed(const Skin& skin, int count) {
  std::array<std::vector<double>, body::kPartCount> errors;
  const engine::Context context;
  const fitting::Items items = fitting::vertex_items(skin.view());
  const std::vector<fitting::Region> regions = fitting::make_regions(items, count);
  const std::vector<int> share = fitting::allocate_ellipsoids({}, items, regions, count);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    fitting::Refinement refinement(context, items, regions[r], fitting::refine_options(skin.stature_m));
    refinement.run(0.0, static_cast<std::size_t>(share[r]));
    for (const fitting::Cluster& c : refinement.clusters()) {
      std::vector<Vec3> points;
      for (const geometry::Index i : c.items) points.push_back(skin.mesh.positions[i]);
      errors[static_cast<int>(c.part)].push_back(mean_radial_distance(c.ellipsoid, points));
    }
  }
  return errors;
}

/// The parts with an E_j above the threshold of their kind.
std::vector<std::string> parts_above(const fitting::FitResult& result) {
  std::vector<std::string> names;
  for (const auto& part : result.parts) {
    const double mu_m = body::is_torso(part.part) ? result.mu_torso_m : result.mu_limbs_m;
    if (part.cluster_error && part.cluster_error->max_m > mu_m) names.emplace_back(body::name(part.part));
  }
  return names;
}

}  // namespace

TEST_CASE("cluster error: of one cluster a part, it is the mean radial distance of the part's vertices") {
  const Skin skin = bent_limbs();
  const auto result = fitting::fit({}, skin.view(), paper(3));
  REQUIRE(result.ok());
  REQUIRE(result->parts.size() == 3);
  for (const auto& part : result->parts) {
    REQUIRE(part.ellipsoids == 1);
    REQUIRE(part.cluster_error.has_value());
    const auto e = std::ranges::find(result->proxy.ellipsoids(), part.part, &proxy::ProxyEllipsoid::part);
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < skin.part.size(); ++v)
      if (skin.part[v] == part.part) points.push_back(skin.mesh.positions[v]);
    const double truth_m = mean_radial_distance(e->shape, points);
    CHECK(truth_m > 1e-3);
    CHECK(part.cluster_error->mean_m == doctest::Approx(truth_m).epsilon(1e-9));
    CHECK(part.cluster_error->max_m == doctest::Approx(truth_m).epsilon(1e-9));
  }
}

TEST_CASE("cluster error: of many clusters a part, mean and maximum are those of their E_j") {
  const Skin skin = bent_limbs();
  for (const int count : {12, 40}) {
    CAPTURE(count);
    const auto result = fitting::fit({}, skin.view(), paper(count));
    REQUIRE(result.ok());
    const auto truth = recomputed(skin, count);
    for (const auto& part : result->parts) {
      const std::vector<double>& errors = truth[static_cast<int>(part.part)];
      REQUIRE(errors.size() == part.ellipsoids);
      double sum = 0.0;
      for (const double e : errors) sum += e;
      CHECK(part.cluster_error->mean_m ==
            doctest::Approx(sum / static_cast<double>(errors.size())).epsilon(1e-9));
      CHECK(part.cluster_error->max_m == doctest::Approx(*std::ranges::max_element(errors)).epsilon(1e-9));
    }
  }
}

TEST_CASE("cluster error: with enough ellipsoids no part exceeds its threshold, and nothing is warned of") {
  const Skin skin = bent_limbs();
  for (const Tier tier : {Tier::kPaper, Tier::kSolid}) {
    const auto result =
        fitting::fit({}, skin.view(), {.tier = tier, .mu_torso_m = 0.016, .mu_limbs_m = 0.010});
    REQUIRE(result.ok());
    for (const auto& part : result->parts) REQUIRE(part.cluster_error.has_value());
    CHECK(parts_above(*result).empty());
    CHECK(result->warnings.empty());
    if (tier == Tier::kSolid) CHECK(result->accuracy.interior_covered_percent == 100.0);
  }
}

TEST_CASE("cluster error: with too few ellipsoids the warning names the parts above mu, and no other") {
  const Skin skin = bent_limbs();
  for (const int count : {1, 3, 8, 20}) {
    CAPTURE(count);
    FitOptions options = paper(count);
    options.mu_torso_m = 0.012;
    options.mu_limbs_m = 0.002;
    const auto result = fitting::fit({}, skin.view(), options);
    REQUIRE(result.ok());
    const auto above = parts_above(*result);
    CHECK(above.empty() == result->warnings.empty());
    if (count < 8) CHECK_FALSE(above.empty());
    if (result->warnings.empty()) continue;
    REQUIRE(result->warnings[0].code == "thresholds-not-reached");
    const std::string& message = result->warnings[0].message;
    for (const auto& part : result->parts) {
      const std::string name(body::name(part.part));
      const bool is_above = std::ranges::find(above, name) != above.end();
      CHECK((message.find(name + " by ") != std::string::npos) == is_above);
    }
  }
}

TEST_CASE("cluster error: thresholds found automatically are the largest cluster errors of torso and limbs") {
  const Skin skin = bent_limbs();
  for (const int count : {1, 2, 5, 30}) {  // with one or two, limbs share the torso's region
    CAPTURE(count);
    const auto result = fitting::fit({}, skin.view(), paper(count));
    REQUIRE(result.ok());
    double torso_m = 0.0, limbs_m = 0.0;
    for (const auto& part : result->parts)
      if (part.cluster_error) {
        double& worst = body::is_torso(part.part) ? torso_m : limbs_m;
        worst = std::max(worst, part.cluster_error->max_m);
      }
    CHECK(result->mu_torso_m == torso_m);
    CHECK(result->mu_limbs_m == limbs_m);
  }
}

TEST_CASE("cluster error: tiers without clusters have none" * doctest::test_suite("long")) {
  const Skin skin = bent_limbs();
  for (const Tier tier : {Tier::kSolid, Tier::kTight, Tier::kRelief}) {
    const auto result = fitting::fit({}, skin.view(), {.tier = tier, .max_ellipsoids = 4});
    REQUIRE(result.ok());
    for (const auto& part : result->parts) CHECK_FALSE(part.cluster_error.has_value());
  }
}
