#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <bodice/engine/clock.hpp>
#include <bodice/engine/executor.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice_test/executors.hpp>

#include "shapes.hpp"

using namespace bodice;
using fitting::FitOptions;
using fitting_test::Skin;
using fitting_test::three_ellipsoids;
using geometry::Vec3;
using proxy::Tier;

namespace {

FitOptions options_for(Tier tier, int count) {
  FitOptions options;
  options.tier = tier;
  options.max_ellipsoids = count;
  return options;
}

}  // namespace

TEST_CASE("fit: every tier recovers three separate ellipsoids from their skin" *
          doctest::test_suite("long")) {
  const Skin skin = three_ellipsoids();
  for (const Tier tier : {Tier::kPaper, Tier::kSolid, Tier::kTight, Tier::kRelief}) {
    const auto result = fitting::fit({}, skin.view(), options_for(tier, 3));
    REQUIRE(result.ok());
    CHECK(result->proxy.tier() == tier);
    CHECK(result->proxy.ellipsoids().size() == 3);
    // A 48-gon's skin lies up to a quarter of a percent of a radius inside the true ellipsoid.
    CHECK(result->accuracy.gap_m.mean < 1.0e-3);
    CHECK(result->accuracy.interior_covered_percent > 99.5);
    for (const auto& e : result->proxy.ellipsoids()) {
      if (e.part != body::Part::kTorsoUL) continue;
      CHECK((e.shape.center - Vec3(0.0, 0.5, 0.0)).norm() < 3e-3);
      Vec3 radii = e.shape.radii;
      std::sort(radii.data(), radii.data() + 3);
      CHECK((radii - Vec3(0.10, 0.16, 0.24)).cwiseAbs().maxCoeff() < 3e-3);
    }
  }
}

TEST_CASE("fit: where ellipsoids of a bent skin do not return to the skin, those of the skin itself serve" *
          doctest::test_suite("long")) {
  const Skin skin = three_ellipsoids();
  FitOptions options = options_for(Tier::kRelief, 6);
  const auto as_it_is = fitting::fit({}, skin.view(), options);
  std::vector<Vec3> folded = skin.mesh.positions;  // all three lie in one another
  for (Vec3& p : folded) p = p.cwiseAbs() - Vec3::Constant(0.1);
  options.flexed = folded;
  const auto bent = fitting::fit({}, skin.view(), options);
  REQUIRE(as_it_is.ok());
  REQUIRE(bent.ok());
  CHECK(bent->accuracy.gap_m.mean == as_it_is->accuracy.gap_m.mean);
}

TEST_CASE("fit: tier paper holds every vertex, tier solid every triangle and the interior") {
  const Skin skin = three_ellipsoids();
  for (const Tier tier : {Tier::kPaper, Tier::kSolid}) {
    const auto result = fitting::fit({}, skin.view(), options_for(tier, 24));
    REQUIRE(result.ok());
    CHECK(result->proxy.ellipsoids().size() <= 24);
    double worst = -1.0;
    for (const Vec3& p : skin.mesh.positions)
      worst = std::max(worst, proxy::proxy_distance(result->proxy, p).distance);
    CHECK(worst < 1e-7);
  }
  for (const int count : {6, 12, 24, 48}) {
    const auto result = fitting::fit({}, skin.view(), options_for(Tier::kSolid, count));
    REQUIRE(result.ok());
    CHECK(result->accuracy.skin_outside_percent == 0.0);
    CHECK(result->accuracy.interior_covered_percent == 100.0);
  }
}

TEST_CASE(
    "fit: tight is more accurate than paper, and relief than tight, where a part needs several ellipsoids" *
    doctest::test_suite("long")) {
  Skin skin;  // two ellipsoids under one label
  fitting_test::add_ellipsoid(skin, {Vec3(0, 0.25, 0), geometry::Mat3::Identity(), Vec3(0.08, 0.25, 0.08)},
                              body::Part::kThighL);
  fitting_test::add_ellipsoid(skin, {Vec3(0.3, 0.8, 0), geometry::Mat3::Identity(), Vec3(0.25, 0.06, 0.08)},
                              body::Part::kThighL);
  skin.stature_m = 1.0;
  for (std::size_t v = 0; v < skin.mesh.positions.size(); ++v) {  // waves of 3 mm, which tables can follow
    Vec3& p = skin.mesh.positions[v];
    p.z() *= 1.0 + 0.04 * std::sin(60.0 * p.x()) * std::cos(50.0 * p.y());
  }
  const auto paper = fitting::fit({}, skin.view(), options_for(Tier::kPaper, 8));
  const auto tight = fitting::fit({}, skin.view(), options_for(Tier::kTight, 8));
  const auto relief = fitting::fit({}, skin.view(), options_for(Tier::kRelief, 8));
  REQUIRE((paper.ok() && tight.ok() && relief.ok()));
  CHECK(tight->accuracy.gap_m.mean < 0.5 * paper->accuracy.gap_m.mean);
  CHECK(relief->accuracy.gap_m.mean < 0.7 * tight->accuracy.gap_m.mean);
  CHECK(relief->proxy.bytes() <= 128 * 1024);
  // Tables are read the fastest over axes by falling radius.
  for (const proxy::ProxyEllipsoid& e : relief->proxy.ellipsoids()) {
    CHECK(e.shape.radii.x() >= e.shape.radii.y());
    CHECK(e.shape.radii.y() >= e.shape.radii.z());
    CHECK(e.shape.axes.determinant() == doctest::Approx(1.0));
  }
}

TEST_CASE("fit: given thresholds are kept and reported, and absent ones are found") {
  const Skin skin = three_ellipsoids();
  FitOptions options;
  options.tier = Tier::kPaper;
  options.mu_torso_m = 0.004;
  options.mu_limbs_m = 0.002;
  const auto result = fitting::fit({}, skin.view(), options);
  REQUIRE(result.ok());
  CHECK(result->mu_torso_m == 0.004);
  CHECK(result->mu_limbs_m == 0.002);
  CHECK(result->warnings.empty());
  for (const auto& part : result->parts)
    CHECK(part.radial_error_mean_m <= (body::is_torso(part.part) ? 0.004 : 0.002));

  const auto automatic = fitting::fit({}, skin.view(), options_for(Tier::kPaper, 30));
  REQUIRE(automatic.ok());
  CHECK(automatic->mu_torso_m > 0.0);
  CHECK(automatic->mu_limbs_m > 0.0);
}

TEST_CASE("fit: thresholds choose tier paper, and options that would ignore them are refused") {
  const Skin skin = three_ellipsoids();
  FitOptions options;
  options.mu_torso_m = 0.004;
  options.mu_limbs_m = 0.002;
  const auto free = fitting::fit({}, skin.view(), options);
  REQUIRE(free.ok());
  CHECK(free->proxy.tier() == Tier::kPaper);
  CHECK(free->mu_torso_m == 0.004);
  options.mu_torso_m = options.mu_limbs_m = 1e-15;
  options.max_ellipsoids = 7;
  const auto bounded = fitting::fit({}, skin.view(), options);
  REQUIRE(bounded.ok());
  CHECK(bounded->proxy.ellipsoids().size() <= 7);
  CHECK(std::ranges::any_of(bounded->warnings,
                            [](const auto& warning) { return warning.code == "thresholds-not-reached"; }));

  const auto refused = [&](FitOptions wrong) {
    const auto result = fitting::fit({}, skin.view(), wrong);
    return !result.ok() && result.error().code == engine::ErrorCode::kInvalidArgument &&
           result.error().message.find("threshold") != std::string::npos;
  };
  CHECK(refused({.mu_torso_m = 0.004}));
  CHECK(refused({.mu_limbs_m = 0.004}));
  CHECK(refused({.tier = Tier::kTight, .mu_torso_m = 0.004, .mu_limbs_m = 0.002}));
  CHECK(refused({.tier = Tier::kRelief, .mu_torso_m = 0.004, .mu_limbs_m = 0.002}));
  CHECK(refused({.target_error_m = 0.002, .mu_torso_m = 0.004, .mu_limbs_m = 0.002}));
  CHECK(refused({.budget_us = 100.0, .mu_torso_m = 0.004, .mu_limbs_m = 0.002}));
}

TEST_CASE("fit: a target error that cannot be reached gives a warning") {
  const Skin skin = three_ellipsoids();
  FitOptions options = options_for(Tier::kPaper, 4);
  options.target_error_m = 1e-6;
  const auto result = fitting::fit({}, skin.view(), options);
  REQUIRE(result.ok());
  REQUIRE(result->warnings.size() == 1);
  CHECK(result->warnings[0].code == "target-error-not-reached");
  options.target_error_m = 0.1;
  CHECK(fitting::fit({}, skin.view(), options)->warnings.empty());
}

TEST_CASE("fit: every tier gives the same bits for 1, 2, 3 and 7 workers" * doctest::test_suite("long")) {
  const Skin skin = three_ellipsoids();
  for (const Tier tier :
       {Tier::kPaper, Tier::kSolid, Tier::kRelief}) {  // relief contains the ellipsoids of tight
    const auto serial = fitting::fit({}, skin.view(), options_for(tier, 12));
    REQUIRE(serial.ok());
    for (const int workers : {2, 3, 7}) {
      const auto executor = bodice_test::make_threads(workers);
      engine::Context context;
      context.executor = executor.get();
      const auto result = fitting::fit(context, skin.view(), options_for(tier, 12));
      REQUIRE(result.ok());
      CHECK(result->proxy.hash() == serial->proxy.hash());
    }
  }
}

TEST_CASE("fit: at any scale and far from the origin the gap is the same fraction of the body" *
          doctest::test_suite("long")) {
  const double gap =
      fitting::fit({}, three_ellipsoids().view(), options_for(Tier::kTight, 6))->accuracy.gap_m.mean;
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    const Skin skin = three_ellipsoids(scale);
    for (const Tier tier : {Tier::kPaper, Tier::kSolid, Tier::kTight, Tier::kRelief}) {
      const auto result = fitting::fit({}, skin.view(), options_for(tier, 6));
      REQUIRE(result.ok());
      CHECK(std::isfinite(result->accuracy.gap_m.mean));
      if (tier == Tier::kTight) CHECK(result->accuracy.gap_m.mean / scale < 1.5 * gap + 1e-4);
    }
  }
  const Skin far = three_ellipsoids(1.0, Vec3(1e4, 0.0, -1e4));
  const auto result = fitting::fit({}, far.view(), options_for(Tier::kTight, 6));
  REQUIRE(result.ok());
  CHECK(result->accuracy.gap_m.mean < 1.5 * gap + 1e-4);
}

TEST_CASE("fit: of two equal limbs the same one is split first, wherever the body stands") {
  const auto counts_at = [](const Vec3& offset) {
    fitting_test::Skin skin;
    skin.stature_m = 1.0;
    const auto add = [&](double x, double y, const Vec3& radii, body::Part part) {
      fitting_test::add_ellipsoid(skin, {offset + Vec3(x, y, 0), geometry::Mat3::Identity(), radii}, part);
    };
    add(0.0, 0.7, {0.12, 0.25, 0.08}, body::Part::kTorsoUL);
    for (const double side : {1.0, -1.0}) {
      add(side * 0.2, 0.7, {0.03, 0.25, 0.04}, side > 0.0 ? body::Part::kForearmL : body::Part::kForearmR);
      add(side * 0.08, 0.2, {0.05, 0.2, 0.07}, side > 0.0 ? body::Part::kThighL : body::Part::kThighR);
    }
    FitOptions options;
    options.tier = Tier::kPaper;
    options.max_ellipsoids = 18;  // so many cannot be shared equally between the pairs
    std::vector<std::size_t> counts;
    const auto result = fitting::fit({}, skin.view(), options);
    REQUIRE(result.ok());
    for (const auto& part : result->parts) counts.push_back(part.ellipsoids);
    return counts;
  };
  const auto expected = counts_at(Vec3::Zero());
  for (const double far : {0.37, 10.0, 777.7, 1e4, 33333.3})
    CHECK(counts_at(Vec3(far, -0.3 * far, 0.7 * far)) == expected);
}

TEST_CASE("fit: improvements are published in order and are valid proxies" * doctest::test_suite("long")) {
  const Skin skin = three_ellipsoids();
  FitOptions options = options_for(Tier::kRelief, 6);
  std::vector<Tier> seen;
  options.on_improved = [&](const proxy::BodyProxy& proxy) { seen.push_back(proxy.tier()); };
  REQUIRE(fitting::fit({}, skin.view(), options).ok());
  REQUIRE(seen.size() >= 2);
  CHECK(seen.front() == Tier::kTight);
  CHECK(seen.back() == Tier::kRelief);
}

TEST_CASE("fit: a time budget is for the whole target search, and only its first try publishes proxies" *
          doctest::test_suite("long")) {
  struct Impatient : engine::Clock {  // every reading is a minute after the one before
    std::int64_t now_ns() const noexcept override { return now.fetch_add(60'000'000'000); }
    mutable std::atomic<std::int64_t> now = 0;
  };
  const Skin skin = three_ellipsoids();
  const auto tries = [](const fitting::FitResult& result) {
    return std::ranges::count_if(result.stages, [](const auto& stage) { return stage.name == "measure"; });
  };
  FitOptions options;
  options.tier = Tier::kTight;
  options.target_error_m = 2e-3;  // the gap formula of bodies gives far too many ellipsoids here
  std::vector<std::size_t> shown;
  options.on_improved = [&](const proxy::BodyProxy& proxy) { shown.push_back(proxy.ellipsoids().size()); };
  const auto patient = fitting::fit({}, skin.view(), options);
  REQUIRE(patient.ok());
  CHECK(tries(*patient) > 1);
  REQUIRE_FALSE(shown.empty());
  CHECK(std::ranges::count(shown, shown.front()) == static_cast<std::ptrdiff_t>(shown.size()));

  const Impatient clock;
  engine::Context context;
  context.clock = &clock;
  options.time_budget_s = 1.0;
  const auto hasty = fitting::fit(context, skin.view(), options);
  REQUIRE(hasty.ok());
  CHECK(tries(*hasty) == 1);
}

TEST_CASE("fit: without any time there is a valid proxy of the wanted parts only, and a warning" *
          doctest::test_suite("long")) {
  const Skin skin = three_ellipsoids();
  FitOptions options = options_for(Tier::kRelief, 6);
  options.time_budget_s = 0.0;
  options.parts = 1u << static_cast<int>(body::Part::kHead);
  const auto result = fitting::fit({}, skin.view(), options);
  REQUIRE(result.ok());
  for (const auto& e : result->proxy.ellipsoids()) CHECK(e.part == body::Part::kHead);
  CHECK(result->parts.size() == 1);
  REQUIRE(result->warnings.size() == 1);
  CHECK(result->warnings[0].code == "time-budget-spent");
  if (result->proxy.tier() == Tier::kTight)
    CHECK(result->warnings[0].message.find("tight in place of relief") != std::string::npos);
  options.time_budget_s = 1000.0;
  CHECK(fitting::fit({}, skin.view(), options)->warnings.empty());
}

TEST_CASE("fit: where a region was cut from the body, the cut counts as no gap") {
  // One ellipsoid's upper half is another part, so that the fitted half ends inside the body.
  Skin skin = three_ellipsoids();
  for (std::size_t v = 0; v < skin.part.size(); ++v)
    if (skin.part[v] == body::Part::kTorsoUL && skin.mesh.positions[v].y() > 0.5)
      skin.part[v] = body::Part::kHead;
  FitOptions options = options_for(Tier::kPaper, 12);
  options.parts = 1u << static_cast<int>(body::Part::kTorsoUL);
  const auto region = fitting::fit({}, skin.view(), options);
  REQUIRE(region.ok());
  // The remaining gap is that of the paper's clusters within the half; the cut would make it 16 and 66 mm.
  CHECK(region->accuracy.gap_m.mean < 0.012);
  CHECK(region->accuracy.gap_m.max < 0.050);
}

TEST_CASE("fit: bad input fails with a sentence that names the element") {
  const Skin good = three_ellipsoids();
  const auto code = [](const fitting::LabeledSkin& skin, const FitOptions& options) {
    const auto result = fitting::fit({}, skin, options);
    return result.ok() ? std::string() : result.error().sentence();
  };
  Skin bad = good;
  bad.part.pop_back();
  CHECK(code(bad.view(), {}).find("labels") != std::string::npos);
  bad = good;
  bad.mesh.positions[5].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK(code(bad.view(), {}).find("Vertex 5") != std::string::npos);
  bad = good;
  bad.mesh.triangles[3][1] = 1u << 30;
  CHECK(code(bad.view(), {}).find("Triangle 3") != std::string::npos);
  bad = good;
  bad.stature_m = 0.0;
  CHECK(code(bad.view(), {}).find("stature_m") != std::string::npos);
  bad = good;
  bad.mesh.triangles.clear();
  CHECK(code(bad.view(), {}).find("no triangles") != std::string::npos);
  FitOptions options;
  options.max_ellipsoids = 0;
  CHECK(code(good.view(), options).find("max_ellipsoids") != std::string::npos);
  options = {};
  options.parts = 1u << static_cast<int>(body::Part::kCalfR);
  CHECK(code(good.view(), options).find("no skin") != std::string::npos);
}

TEST_CASE("fit: canceled work fails with kCanceled") {
  const Skin skin = three_ellipsoids();
  engine::CancelSource source;
  source.cancel();
  engine::Context context;
  context.cancel = source.token();
  const auto result = fitting::fit(context, skin.view(), options_for(Tier::kTight, 6));
  REQUIRE_FALSE(result.ok());
  CHECK(result.error().code == engine::ErrorCode::kCanceled);
}

TEST_CASE("fit: distances to the skin are prepared only for tiers and measurements that need them") {
  const Skin skin = three_ellipsoids();
  const auto prepared = [&](Tier tier, bool measured) {
    FitOptions options = options_for(tier, 3);
    options.measure_accuracy = measured;
    const auto result = fitting::fit({}, skin.view(), options);
    REQUIRE(result.ok());
    REQUIRE(result->proxy.ellipsoids().size() == 3);
    return std::ranges::count_if(result->stages, [](const auto& stage) { return stage.name == "distance"; });
  };
  CHECK(prepared(Tier::kPaper, false) == 0);
  CHECK(prepared(Tier::kPaper, true) == 1);
  CHECK(prepared(Tier::kSolid, false) == 1);
  CHECK(prepared(Tier::kTight, false) == 1);
}
