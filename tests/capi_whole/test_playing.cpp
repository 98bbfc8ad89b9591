// Motions of sessions: played, paused, resumed, sought.
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "capi_whole/body.hpp"

using namespace capi_test;
using namespace bodice;

TEST_CASE("capi: the clock of a motion stands while paused, goes on, and is where it was sent") {
  const Context context = make_context(1);
  bodice_session_options options = bodice_default_session_options();
  options.tier = BODICE_SOLID;
  options.moves = 1;
  auto session = Session::create(context, options);
  REQUIRE_MESSAGE(session, bodice_last_error());
  MeshArrays body(make_body().mesh);
  must(session->submit(body.mesh()));
  must(bodice_session_play(session->get(), "walk", nullptr));
  const auto step = [&](double dt_s) {
    const auto report = session->step(dt_s);
    REQUIRE_MESSAGE(report, bodice_last_error());
    return *report;
  };
  // The ramp from the bind pose comes first.
  bodice_step_report report = step(1.0 / 60.0);
  for (int i = 0; i < 600 && !(report.has_body && report.clip_s > 0.1); ++i) report = step(1.0 / 60.0);
  REQUIRE(report.clip_s > 0.1);

  must(bodice_session_pause(session->get()));
  const double paused_s = step(0.02).clip_s;
  CHECK(step(0.02).clip_s == paused_s);
  must(bodice_session_resume(session->get()));
  CHECK(step(0.02).clip_s == doctest::Approx(paused_s + 0.02));
  must(bodice_session_seek(session->get(), 0.5, 0.0));
  CHECK(step(0.02).clip_s == doctest::Approx(0.52));

  CHECK(bodice_session_seek(session->get(), -1.0, 0.0) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_session_seek(session->get(), 0.0, std::nan("")) == BODICE_INVALID_ARGUMENT);
  CHECK(step(0.0).clip_s == doctest::Approx(0.52));
}

TEST_CASE(
    "capi: a clip that finer proxies look for anew is no failure, and one that is not there is one once") {
  const Context context = make_context(2);
  bodice_session_options options = bodice_default_session_options();
  options.moves = 1;
  auto session = Session::create(context, options);
  REQUIRE_MESSAGE(session, bodice_last_error());
  MeshArrays body(make_body().mesh);
  must(session->submit(body.mesh()));
  std::int32_t state = BODICE_IDLE;
  bool plays = false;
  for (int i = 0; i < 60000 && state != BODICE_READY; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // the fit goes on beside the steps
    const auto report = session->step(1.0 / 60.0);
    REQUIRE_MESSAGE(report, bodice_last_error());
    // The coarse body begins the search, while finer ones are on their path.
    if (report->has_body && !std::exchange(plays, true))
      must(bodice_session_play(session->get(), "walk", nullptr));
    must(bodice_session_poll(session->get(), &state));
  }
  CHECK(plays);
  REQUIRE(state == BODICE_READY);

  must(bodice_session_play(session->get(), "wlak", nullptr));
  int failures = 0, after = 0;
  for (int i = 0; i < 10000 && after < 50; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    after += failures;
    REQUIRE(session->step(1.0 / 60.0));
    const bodice_status status = bodice_session_poll(session->get(), &state);
    failures += status == BODICE_NOT_FOUND;
    CHECK((status == BODICE_OK || status == BODICE_NOT_FOUND));
    CHECK(state == BODICE_READY);
  }
  CHECK(failures == 1);
}
