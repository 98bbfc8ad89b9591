// A body's preparation as a graph of tasks: it gives the same proxies in the same order on every executor,
// computes nothing for parts that no garment reaches, and ends at any cancellation.

#include <doctest/doctest.h>

#include <algorithm>
#include <thread>

#include <bodice/engine/random.hpp>
#include <bodice/engine/trace.hpp>
#include <bodice/tryon/preparation.hpp>
#include <bodice/tryon/wearing.hpp>
#include <bodice_test/executors.hpp>

#include "builtin.hpp"

using namespace bodice;

namespace {

tryon::PreparationOptions options_for(proxy::Tier tier) {
  tryon::PreparationOptions options;
  options.fit.tier = tier;
  return options;
}

/// The same with few ellipsoids, so that a fit ends soon.
tryon::PreparationOptions quick_options_for(proxy::Tier tier) {
  tryon::PreparationOptions options = options_for(tier);
  options.fit.max_ellipsoids = 40;
  return options;
}

/// The hashes of the published proxies, in order.
std::vector<std::uint64_t> proxies_of(const engine::Context& context, proxy::Tier tier) {
  std::vector<std::uint64_t> hashes;
  const tryon::PreparationOptions options = quick_options_for(tier);
  auto preparation = tryon::Preparation::make(
      options, [&](const auto&, const proxy::BodyProxy& proxy) { hashes.push_back(proxy.hash()); });
  REQUIRE(preparation.ok());
  const auto run = preparation->run(context, synth::BodyOptions{.vertices = 1500});
  REQUIRE_MESSAGE(run.ok(), run.error().sentence());
  REQUIRE(preparation->fit() != nullptr);
  CHECK(hashes.back() == preparation->fit()->proxy.hash());
  return hashes;
}

geometry::TriMesh skirt_on(const tryon::SegmentedSkin& skin) {
  auto garment = tryon::make_garment({}, skin, {.kind = synth::GarmentKind::kSkirt});
  REQUIRE(garment.ok());
  return std::move(garment->mesh);
}

bool traced(const std::vector<engine::TraceEvent>& events, std::string_view name) {
  return std::ranges::any_of(events, [&](const auto& event) { return event.name == name; });
}

}  // namespace

TEST_CASE(
    "proxies are published coarse to fine, in the same order and with the same bits on every executor") {
  const std::vector<std::uint64_t> expected = proxies_of({}, proxy::Tier::kTight);
  CHECK(expected.size() >= 2);
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    CHECK(proxies_of({.executor = executor.get()}, proxy::Tier::kTight) == expected);
  }
}

TEST_CASE("no intermediate proxy has more ellipsoids than the options allow") {
  auto options = options_for(proxy::Tier::kTight);
  options.fit.max_ellipsoids = 20;
  std::vector<std::size_t> counts;
  auto preparation = tryon::Preparation::make(
      options, [&](const auto&, const proxy::BodyProxy& p) { counts.push_back(p.ellipsoids().size()); });
  REQUIRE(preparation.ok());
  REQUIRE(preparation->run({}, synth::BodyOptions{.vertices = 1500}).ok());
  REQUIRE(counts.size() > 3);
  // While parts are published one by one, solid parts are beside coarse ones.
  CHECK(*std::ranges::max_element(counts) <= 20);
}

TEST_CASE("each solid part replaces the coarse one as soon as it is ready") {
  std::vector<proxy::BodyProxy> proxies;
  auto preparation =
      tryon::Preparation::make(options_for(proxy::Tier::kSolid),
                               [&](const auto&, const proxy::BodyProxy& p) { proxies.push_back(p); });
  REQUIRE(preparation.ok());
  REQUIRE(preparation->run({}, synth::BodyOptions{.vertices = 3000}).ok());
  REQUIRE(proxies.size() >= 10);  // the coarse proxy, then the torso and the limbs
  CHECK(proxies.front().ellipsoids().size() == body::kPartCount);
  auto of_part = [](const proxy::BodyProxy& p, int part) {
    std::vector<geometry::Vec3> centers;
    for (const auto& e : p.ellipsoids())
      if (static_cast<int>(e.part) == part) centers.push_back(e.shape.center);
    return centers;
  };
  for (int part = 0; part < body::kPartCount; ++part) {
    int changes = 0;
    for (std::size_t k = 1; k < proxies.size(); ++k) {
      CHECK_FALSE(of_part(proxies[k], part).empty());  // no proxy lacks a part
      changes += of_part(proxies[k], part) != of_part(proxies[k - 1], part);
    }
    // From coarse to solid, and once more where the interior of the whole body needs more coverage.
    CHECK(changes >= 1);
    CHECK(changes <= 2);
  }
}

TEST_CASE("one preparation handles one body after the other") {
  auto preparation = tryon::Preparation::make(options_for(proxy::Tier::kPaper), {});
  REQUIRE(preparation.ok());
  std::vector<double> statures;
  for (const double stature_m : {1.6, 1.8}) {
    REQUIRE(preparation->run({}, synth::BodyOptions{.stature_m = stature_m, .vertices = 1500}).ok());
    statures.push_back(preparation->fit()->proxy.stature_m());
  }
  CHECK(statures[1] - statures[0] == doctest::Approx(0.2).epsilon(0.1));
  CHECK_FALSE(preparation->run({}, tryon::BodyFile{"nowhere.obj"}).ok());
  CHECK(preparation->fit() == nullptr);  // no result of the earlier body is left
  const std::string dot = preparation->dump_dot();
  for (const char* edge : {"\"body\" -> \"anatomy\"", "\"body\" -> \"distance field\"",
                           "\"region\" -> \"proxy\"", "\"coarse proxy\" -> \"solid parts\""})
    CHECK_MESSAGE(dot.find(edge) != std::string::npos, edge);
}

TEST_CASE("parts that no garment reaches are not computed, by the trace") {
  const tryon::SegmentedSkin& skin = builtin_skin(3000);
  auto trace_of = [&](std::vector<geometry::TriMesh> garments, std::uint32_t& parts) {
    engine::Trace trace;
    auto options = options_for(proxy::Tier::kPaper);
    options.garments = std::move(garments);
    auto preparation = tryon::Preparation::make(std::move(options), {});
    REQUIRE(preparation.ok());
    REQUIRE(preparation->run({.trace = &trace}, skin.input).ok());
    parts = 0;
    for (const auto& e : preparation->fit()->proxy.ellipsoids()) parts |= 1u << static_cast<unsigned>(e.part);
    return trace.events();
  };
  std::uint32_t whole = 0, reached = 0;
  const auto all = trace_of({}, whole), some = trace_of({skirt_on(skin)}, reached);
  CHECK(traced(all, "refine head"));
  CHECK(traced(all, "refine thigh_l"));
  CHECK_FALSE(traced(some, "refine head"));
  CHECK(traced(some, "refine thigh_l"));
  CHECK(whole == (1u << body::kPartCount) - 1);
  CHECK((reached & 1u << static_cast<unsigned>(body::Part::kHead)) == 0);
  CHECK((reached & 1u << static_cast<unsigned>(body::Part::kThighL)) != 0);

  auto far = options_for(proxy::Tier::kPaper);
  far.garments = {skirt_on(skin)};
  for (geometry::Vec3& p : far.garments[0].positions) p.x() += 10.0;
  auto preparation = tryon::Preparation::make(std::move(far), {});
  const auto run = preparation->run({}, skin.input);
  REQUIRE_FALSE(run.ok());
  CHECK(run.error().message.find("within reach") != std::string::npos);
}

TEST_CASE("a preparation that is canceled at any moment leaves complete proxies, and can run again") {
  const auto executor = bodice_test::make_threads(2);
  std::vector<std::uint64_t> known = proxies_of({}, proxy::Tier::kTight);
  std::ranges::sort(known);
  std::vector<std::uint64_t> seen;
  auto preparation = tryon::Preparation::make(
      quick_options_for(proxy::Tier::kTight),
      [&](const auto&, const proxy::BodyProxy& proxy) { seen.push_back(proxy.hash()); });
  REQUIRE(preparation.ok());
  engine::Random random(5);
  int canceled = 0;
  for (int round = 0; round < 20; ++round) {
    engine::CancelSource cancel;
    if (round == 0) cancel.cancel();
    std::thread canceller([&cancel, wait = std::chrono::microseconds(
                                        static_cast<int>(random.uniform() * random.uniform() * 100'000))] {
      std::this_thread::sleep_for(wait);
      cancel.cancel();
    });
    const auto run = preparation->run({.executor = executor.get(), .cancel = cancel.token()},
                                      synth::BodyOptions{.vertices = 1500});
    canceller.join();
    if (!run) CHECK(run.error().code == engine::ErrorCode::kCanceled);
    canceled += !run;
    CHECK((preparation->fit() != nullptr) == run.ok());
  }
  CHECK(canceled > 0);
  for (const std::uint64_t hash : seen) CHECK(std::ranges::binary_search(known, hash));
  const std::size_t before = seen.size();
  CHECK(preparation->run({.executor = executor.get()}, synth::BodyOptions{.vertices = 1500}).ok());
  CHECK(seen.size() > before);
}
