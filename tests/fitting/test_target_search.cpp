// A target error or a budget is reached on skins from which no constant of the target search was made.
#include <doctest/doctest.h>

#include <cmath>
#include <optional>

#include <bodice/fitting/fit.hpp>

#include "shapes.hpp"

using namespace bodice;
using fitting::FitOptions;
using fitting_test::bent_limbs;
using fitting_test::Skin;
using geometry::Vec3;
using proxy::Tier;

TEST_CASE("target search: a target error is reached within a fifth, from relief to a handful of ellipsoids" *
          doctest::test_suite("long")) {
  const Skin skin = bent_limbs();
  for (const double target_mm : {1.0, 2.0, 4.0, 8.0}) {
    FitOptions options;
    options.target_error_m = 1e-3 * target_mm;
    const auto result = fitting::fit({}, skin.view(), options);
    REQUIRE(result.ok());
    CAPTURE(target_mm);
    CAPTURE(result->proxy.ellipsoids().size());
    const double achieved_mm = 1e3 * result->accuracy.gap_m.mean;
    CAPTURE(achieved_mm);
    CHECK(achieved_mm < 1.2 * target_mm);
    CHECK(achieved_mm > target_mm / 1.2);
    CHECK(result->warnings.empty());
  }
}

TEST_CASE("target search: a coarser target never takes more ellipsoids" * doctest::test_suite("long")) {
  const Skin skin = bent_limbs();
  std::optional<std::size_t> finer;
  for (const double target_mm : {2.0, 3.0, 5.0, 8.0}) {
    FitOptions options;
    options.tier = Tier::kTight;
    options.target_error_m = 1e-3 * target_mm;
    const auto result = fitting::fit({}, skin.view(), options);
    REQUIRE(result.ok());
    if (finer) CHECK(result->proxy.ellipsoids().size() <= *finer);
    finer = result->proxy.ellipsoids().size();
  }
}

TEST_CASE("uniform offset: a target that no count reaches is met by covering more skin" *
          doctest::test_suite("long")) {
  const Skin skin = bent_limbs();
  const auto with = [&](int count) {
    return fitting::fit({}, skin.view(), {.tier = Tier::kTight, .max_ellipsoids = count});
  };
  const auto three = with(3), two = with(2);
  REQUIRE((three.ok() && two.ok()));
  const double finer_m = three->accuracy.gap_m.mean, target_m = 2.0 * finer_m;
  REQUIRE(two->accuracy.gap_m.mean > 1.1 * target_m);  // no count comes within a tenth of the target
  FitOptions options;
  options.tier = Tier::kTight;
  options.target_error_m = target_m;
  const auto result = fitting::fit({}, skin.view(), options);
  REQUIRE(result.ok());
  CHECK(result->accuracy.gap_m.mean == doctest::Approx(target_m).epsilon(0.1));
  CHECK(result->proxy.ellipsoids().size() == 3);
  CHECK(result->accuracy.skin_outside_percent < 0.5 * three->accuracy.skin_outside_percent);
}

TEST_CASE("budget: more time gives a finer proxy, and a budget below a query's fixed cost gives a warning" *
          doctest::test_suite("long")) {
  const Skin skin = bent_limbs();
  std::size_t fewer = 0;
  for (const double budget_us : {5.0, 90.0, 140.0, 250.0}) {
    FitOptions options;
    options.budget_us = budget_us;
    const auto result = fitting::fit({}, skin.view(), options);
    REQUIRE(result.ok());
    CAPTURE(budget_us);
    const std::size_t count = result->proxy.ellipsoids().size();
    CHECK(result->proxy.tier() == (budget_us > 120.0 ? Tier::kRelief : Tier::kTight));
    CHECK(count >= 12);  // fewer save no time, and up to four of sixteen may hold no skin
    const bool warned = !result->warnings.empty() && result->warnings[0].code == "budget-not-reached";
    CHECK(warned == (budget_us < 50.0));
    if (budget_us > 200.0) CHECK(count > 2 * fewer);
    fewer = count;
  }
}

TEST_CASE("solid: a limit above the useful number of ellipsoids costs less than a tenth of the gap" *
          doctest::test_suite("long")) {
  const Skin skin = bent_limbs();
  const auto gap_m = [&](int most) {
    const auto result = fitting::fit({}, skin.view(), {.tier = Tier::kSolid, .max_ellipsoids = most});
    REQUIRE(result.ok());
    return result->accuracy.gap_m.mean;
  };
  const double of_120 = gap_m(120);
  for (const int most : {200, 400, 4096}) {
    CAPTURE(most);
    CHECK(gap_m(most) < 1.1 * of_120);
  }
  const auto out_of_reach = fitting::fit({}, skin.view(), {.tier = Tier::kSolid, .target_error_m = 1e-4});
  REQUIRE(out_of_reach.ok());
  CHECK(out_of_reach->accuracy.gap_m.mean < 1.1 * of_120);
}

TEST_CASE("tight: no ellipsoid stands in the air between limbs, however few there are" *
          doctest::test_suite("long")) {
  const Skin skin = bent_limbs();
  for (const int count : {2, 3, 5, 9}) {
    FitOptions options;
    options.tier = Tier::kTight;
    options.max_ellipsoids = count;
    const auto result = fitting::fit({}, skin.view(), options);
    REQUIRE(result.ok());
    CAPTURE(count);
    // Two ellipsoids cannot follow three limbs; with more, no gap exceeds the thickness of a limb.
    CHECK(result->accuracy.gap_m.max < (count == 2 ? 0.24 : 0.16));
  }
}

TEST_CASE("fit: without measured accuracy the proxy has the same bits, and only a target error measures") {
  const Skin skin = fitting_test::three_ellipsoids();
  FitOptions options;
  options.tier = Tier::kSolid;
  options.max_ellipsoids = 12;
  const auto measured = fitting::fit({}, skin.view(), options);
  options.measure_accuracy = false;
  const auto silent = fitting::fit({}, skin.view(), options);
  REQUIRE((measured.ok() && silent.ok()));
  CHECK(silent->proxy.hash() == measured->proxy.hash());
  CHECK(measured->accuracy.gap_m.mean > 0.0);
  CHECK(silent->accuracy.gap_m.mean == 0.0);
  for (const auto& stage : silent->stages) CHECK(stage.name != "measure");
  options.target_error_m = 0.05;
  CHECK(fitting::fit({}, skin.view(), options)->accuracy.gap_m.mean > 0.0);
}
