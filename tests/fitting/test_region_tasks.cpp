#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <bodice/engine/executor.hpp>
#include <bodice/engine/trace.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice_test/executors.hpp>

#include "shapes.hpp"

using namespace bodice;
using fitting::FitOptions;
using fitting_test::three_ellipsoids;
using proxy::Tier;

namespace {

FitOptions options_for(Tier tier) {
  FitOptions options;
  options.tier = tier;
  options.max_ellipsoids = 12;
  return options;
}

}  // namespace

TEST_CASE("region tasks: each wanted region has a task with its name, and no other region has one") {
  const auto skin = three_ellipsoids();
  for (const auto& [tier, verb] : {std::pair(Tier::kPaper, "refine "), std::pair(Tier::kSolid, "cover ")}) {
    FitOptions options = options_for(tier);
    options.parts =
        (1u << static_cast<int>(body::Part::kHead)) | (1u << static_cast<int>(body::Part::kTorsoUL));
    engine::Trace trace;
    engine::Context context;
    context.trace = &trace;
    REQUIRE(fitting::fit(context, skin.view(), options).ok());
    const std::string json = trace.json();
    CHECK(json.find(verb + std::string("torso")) != std::string::npos);
    CHECK(json.find(verb + std::string("head")) != std::string::npos);
    CHECK(json.find(verb + std::string("thigh_l")) == std::string::npos);
  }
}

TEST_CASE("region tasks: each region is published once, and the result consists of them") {
  const auto skin = three_ellipsoids();
  for (const int workers : {1, 2, 5}) {
    const auto executor = bodice_test::make_threads(workers);
    engine::Context context;
    context.executor = executor.get();
    FitOptions options = options_for(Tier::kPaper);
    std::map<std::string, std::vector<proxy::ProxyEllipsoid>> parts;
    options.on_part = [&](const fitting::FittedPart& part) {
      CHECK(parts.emplace(part.name, std::vector(part.ellipsoids.begin(), part.ellipsoids.end())).second);
    };
    const auto result = fitting::fit(context, skin.view(), options);
    REQUIRE(result.ok());
    CHECK(parts.size() == 3);
    std::size_t handed = 0;
    for (const auto& [name, ellipsoids] : parts)
      for (const auto& e : ellipsoids) {
        ++handed;
        const auto same = [&](const auto& other) {
          return (other.shape.center - e.shape.center).norm() < 1e-9;
        };
        const auto all = result->proxy.ellipsoids();
        CHECK(std::any_of(all.begin(), all.end(), same));
      }
    CHECK(handed == result->proxy.ellipsoids().size());
  }
}

TEST_CASE("region tasks: paper and solid give some parts the same bits as in a fit of the whole body" *
          doctest::test_suite("long")) {
  const auto skin = three_ellipsoids();
  const auto executor = bodice_test::make_threads(3);
  engine::Context context;
  context.executor = executor.get();
  for (const Tier tier : {Tier::kPaper, Tier::kSolid})
    for (const std::optional<int> count : {std::optional<int>(), std::optional(12), std::optional(3)}) {
      FitOptions options = options_for(tier);
      options.max_ellipsoids = count;
      const auto whole = fitting::fit({}, skin.view(), options);
      REQUIRE(whole.ok());
      std::size_t together = 0;
      for (const body::Part part : {body::Part::kHead, body::Part::kTorsoUL, body::Part::kThighL}) {
        options.parts = 1u << static_cast<int>(part);
        const auto some = fitting::fit(context, skin.view(), options);
        REQUIRE(some.ok());
        std::vector<proxy::ProxyEllipsoid> same;
        for (const auto& e : whole->proxy.ellipsoids())
          if (e.part == part) same.push_back(e);
        REQUIRE(some->proxy.ellipsoids().size() == same.size());
        for (std::size_t k = 0; k < same.size(); ++k) {
          const auto& e = some->proxy.ellipsoids()[k];
          CHECK(e.part == part);
          CHECK(e.shape.center == same[k].shape.center);
          CHECK(e.shape.axes == same[k].shape.axes);
          CHECK(e.shape.radii == same[k].shape.radii);
        }
        together += same.size();
        CHECK(some->parts.size() == 1);
      }
      CHECK(together == whole->proxy.ellipsoids().size());
    }
}

TEST_CASE("region tasks: tight and relief give some parts their share of the body's ellipsoids and bytes" *
          doctest::test_suite("long")) {
  const auto skin = three_ellipsoids();
  for (const Tier tier : {Tier::kTight, Tier::kRelief}) {
    FitOptions options = options_for(tier);
    const auto whole = fitting::fit({}, skin.view(), options);
    options.parts = 1u << static_cast<int>(body::Part::kHead);
    const auto some = fitting::fit({}, skin.view(), options);
    REQUIRE((whole.ok() && some.ok()));
    CHECK(some->proxy.ellipsoids().size() < whole->proxy.ellipsoids().size());
    CHECK(2 * some->proxy.bytes() < whole->proxy.bytes());
    CHECK(some->accuracy.gap_m.mean < 1.5 * whole->accuracy.gap_m.mean + 1e-4);
    options.max_ellipsoids = 1;  // one for the whole body; a single part still gets one
    const auto one = fitting::fit({}, skin.view(), options);
    REQUIRE(one.ok());
    CHECK(one->proxy.ellipsoids().size() == 1);
  }
}

TEST_CASE("region tasks: regions are published in the same order, whichever task ends first" *
          doctest::test_suite("long")) {
  const auto skin = three_ellipsoids();
  for (const Tier tier : {Tier::kPaper, Tier::kSolid})
    for (const int workers : {1, 2, 5})
      for (int repeat = 0; repeat < 5; ++repeat) {
        const auto executor = bodice_test::make_threads(workers);
        engine::Context context;
        context.executor = executor.get();
        FitOptions options = options_for(tier);
        std::vector<std::string> names;
        options.on_part = [&](const fitting::FittedPart& part) { names.emplace_back(part.name); };
        REQUIRE(fitting::fit(context, skin.view(), options).ok());
        CHECK(names == std::vector<std::string>{"head", "torso", "thigh_l"});
      }
}

TEST_CASE("region tasks: six seeds of a small torso do not exceed the limit") {
  auto skin = three_ellipsoids();
  for (std::size_t v = 0; v < skin.part.size(); ++v) {
    if (!body::is_torso(skin.part[v])) continue;
    geometry::Vec3& p = skin.mesh.positions[v];
    p = geometry::Vec3(0, 0.5, 0) + 0.1 * (p - geometry::Vec3(0, 0.5, 0));
    const int row = p.y() > 0.508 ? 0 : p.y() > 0.492 ? 1 : 2;
    skin.part[v] = static_cast<body::Part>(static_cast<int>(body::Part::kTorsoUL) + 2 * row + (p.x() < 0.0));
  }
  for (const int count : {20, 24, 40}) {
    FitOptions options = options_for(Tier::kPaper);
    options.max_ellipsoids = count;
    const auto result = fitting::fit({}, skin.view(), options);
    REQUIRE(result.ok());
    CHECK(result->proxy.ellipsoids().size() <= static_cast<std::size_t>(count));
  }
}

TEST_CASE("region tasks: with fewer ellipsoids than regions, the limit holds and every vertex is inside") {
  const auto skin = three_ellipsoids();
  for (const int count : {1, 2, 3}) {
    for (const Tier tier : {Tier::kPaper, Tier::kSolid}) {
      FitOptions options = options_for(tier);
      options.max_ellipsoids = count;
      const auto result = fitting::fit({}, skin.view(), options);
      REQUIRE(result.ok());
      CHECK(result->proxy.ellipsoids().size() <= static_cast<std::size_t>(count));
      for (const geometry::Vec3& p : skin.mesh.positions) {
        bool held = false;
        for (const auto& e : result->proxy.ellipsoids())
          held = held || geometry::level(e.shape, p) <= 1.0 + 1e-9;
        if (!held) FAIL_CHECK("a vertex is left out");
      }
    }
  }
}
