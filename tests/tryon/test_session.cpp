// Bodies that are prepared behind the frames take effect at frame boundaries. The newest one is used, and a
// run can be repeated.

#include <doctest/doctest.h>

#include <bodice/tryon/session.hpp>
#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>

#include "sheet.hpp"

using namespace bodice;

namespace {

std::uint64_t run_deterministic(engine::Executor& executor) {
  const engine::Context context{.executor = &executor};
  tryon::SessionOptions options;
  options.pipeline.mode = engine::PipelineMode::kDeterministic;
  options.pipeline.delay_frames = 3;
  options.fit.tier = proxy::Tier::kSolid;
  tryon::Session session(context, options);
  REQUIRE(session.dress({sheet(12)}).ok());
  session.submit(synth::BodyOptions{.vertices = 2600});
  for (int frame = 0; frame < 12; ++frame) session.frame(1.0 / 60.0);
  REQUIRE(session.body() != nullptr);
  return session.hash();
}

}  // namespace

TEST_CASE("garments keep their positions until there is a body, then fall on it") {
  const auto executor = bodice_test::make_threads(2);
  const engine::Context context{.executor = executor.get()};
  tryon::Session session(context, {.fit = {.tier = proxy::Tier::kSolid}});
  REQUIRE(session.dress({sheet(12)}).ok());
  CHECK(session.vertices() == 144);
  std::vector<geometry::Vec3> at(session.vertices());
  session.frame(1.0 / 60.0);
  session.positions(at);
  CHECK(at[0].y() == doctest::Approx(1.75));  // there is no body yet

  const engine::Ticket ticket = session.submit(synth::BodyOptions{.vertices = 2600});
  REQUIRE(ticket.wait().ok());
  for (int frame = 0; frame < 60; ++frame) CHECK(session.frame(1.0 / 60.0).cloth.finite);
  REQUIRE(session.body() != nullptr);
  session.positions(at);
  CHECK(at[0].y() < 1.74);
  CHECK(at[0].y() > 1.2);  // head or shoulders hold it up
}

TEST_CASE("a newer body replaces one that is still being prepared") {
  const auto executor = bodice_test::make_threads(2);
  const engine::Context context{.executor = executor.get()};
  tryon::Session session(context, {.fit = {.tier = proxy::Tier::kSolid}});
  engine::Ticket first =
      session.submit(synth::BodyOptions{.stature_m = 1.5, .mass_kg = 50, .vertices = 8850});
  engine::Ticket second =
      session.submit(synth::BodyOptions{.stature_m = 1.9, .mass_kg = 80, .vertices = 2600});
  REQUIRE(second.wait().ok());
  session.frame(1.0 / 60.0);
  REQUIRE(session.body() != nullptr);
  CHECK(session.body()->proxy.stature_m() > 1.75);
  const auto superseded = first.wait();  // or success, if it ended before the second one came
  if (!superseded) CHECK(superseded.error().code == engine::ErrorCode::kCanceled);
}

TEST_CASE("if two bodies wait for a frame, the newer one is used and the ticket of the other is canceled") {
  tryon::Session session({}, {.fit = {.tier = proxy::Tier::kSolid}});
  const engine::Ticket older = session.submit(synth::BodyOptions{.stature_m = 1.5, .mass_kg = 50});
  const engine::Ticket newer = session.submit(synth::BodyOptions{.stature_m = 1.9, .mass_kg = 80});
  REQUIRE(session.frame(1.0 / 60.0).has_body);
  CHECK(session.body()->proxy.stature_m() > 1.8);
  CHECK(newer.wait().ok());
  const auto superseded = older.wait();
  REQUIRE_FALSE(superseded.ok());
  CHECK(superseded.error().code == engine::ErrorCode::kCanceled);
}

TEST_CASE("a body that cannot be read gives its ticket an error, and frames continue") {
  const engine::Context context;
  tryon::Session session(context, {});
  const engine::Ticket ticket = session.submit(tryon::BodyFile{"nowhere.obj"});
  const auto result = ticket.wait();
  REQUIRE_FALSE(result.ok());
  CHECK(result.error().sentence().find("nowhere.obj") != std::string::npos);
  CHECK_FALSE(session.frame(1.0 / 60.0).has_body);
}

TEST_CASE("with one worker a frame prepares the body itself, before and after the first") {
  tryon::Session session({}, {.fit = {.tier = proxy::Tier::kSolid}});
  REQUIRE(session.dress({sheet(12)}).ok());
  CHECK_FALSE(session.frame(1.0 / 60.0).has_body);
  session.submit(synth::BodyOptions{.stature_m = 1.5, .mass_kg = 50, .vertices = 1500});
  REQUIRE(session.frame(1.0 / 60.0).has_body);
  CHECK(session.body()->proxy.stature_m() < 1.6);
  session.submit(synth::BodyOptions{.stature_m = 1.9, .mass_kg = 80, .vertices = 1500});
  REQUIRE(session.frame(1.0 / 60.0).has_body);
  CHECK(session.body()->proxy.stature_m() > 1.8);
}

TEST_CASE("in deterministic mode a run repeats to the bit, whatever the workers") {
  const std::uint64_t serial = run_deterministic(engine::inline_executor());
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    CHECK(run_deterministic(*executor) == serial);
  }
}

TEST_CASE("a frame of a dressed body allocates nothing once warm") {
  if (!bodice_test::counts_allocations()) return;
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    tryon::Session session({.executor = executor.get()}, {.fit = {.tier = proxy::Tier::kSolid}});
    REQUIRE(session.dress({sheet(12)}).ok());
    REQUIRE(session.submit(synth::BodyOptions{.vertices = 1500}).wait().ok());
    session.frame(1.0 / 60.0);
    REQUIRE(session.body() != nullptr);
    CHECK(bodice_test::allocations_when_warm(5, [&] { session.frame(1.0 / 60.0); }) == 0);
  }
}
