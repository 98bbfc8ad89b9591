#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include <bodice/engine/stage_timer.hpp>
#include <bodice/engine/trace.hpp>
#include <bodice_test/temp_folder.hpp>

using namespace bodice::engine;

namespace {

struct StepClock final : Clock {
  std::int64_t now_ns() const noexcept override { return now += 1000; }
  mutable std::int64_t now = 0;
};

}  // namespace

TEST_CASE("a span records its name, its times and its value; nested spans come outer first") {
  StepClock clock;
  Trace trace(16);
  Context context{.trace = &trace, .clock = &clock};
  {
    TraceSpan outer(context, "frame", 7);
    TraceSpan inner(context, "solve");
  }
  trace_instant(context, "published");
  const auto events = trace.events();
  REQUIRE(events.size() == 3);
  CHECK(std::string(events[0].name) == "frame");
  CHECK(events[0].value == 7);
  CHECK(events[0].begin_ns == 1000);
  CHECK(events[0].end_ns == 4000);
  CHECK(std::string(events[1].name) == "solve");
  CHECK(events[1].end_ns == 3000);
  CHECK(events[2].begin_ns == events[2].end_ns);
}

TEST_CASE("the JSON is the trace-event format, with names escaped") {
  StepClock clock;
  Trace trace(16);
  Context context{.trace = &trace, .clock = &clock};
  { TraceSpan span(context, "a \"quoted\"\\name\n", 3); }
  const std::string json = trace.json();
  CHECK(json.find(R"({"ph":"X","pid":1,"tid":0,"name":"a \"quoted\"\\name ","ts":0.000,"dur":1.000,)"
                  R"("args":{"value":3}})") != std::string::npos);
  CHECK(json.find(R"("dropped":0)") != std::string::npos);
}

TEST_CASE("a full trace keeps the first events, counts the rest, and cuts long names") {
  StepClock clock;
  Trace trace(4);
  Context context{.trace = &trace, .clock = &clock};
  const std::string name(200, 'x');
  for (int i = 0; i < 10; ++i) TraceSpan(context, name, i);
  CHECK(trace.dropped() == 6);
  const auto events = trace.events();
  REQUIRE(events.size() == 4);
  CHECK(std::string(events[0].name) == std::string(TraceEvent::kMaxName, 'x'));
}

TEST_CASE("many threads record at once and nothing is lost or torn") {
  Trace trace(4096);
  Context context{.trace = &trace};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      const std::string name(10, static_cast<char>('a' + t));
      for (int i = 0; i < 1000; ++i) TraceSpan(context, name, t);
    });
  }
  for (std::thread& thread : threads) thread.join();
  const auto events = trace.events();
  CHECK(events.size() == 4000);
  for (const TraceEvent& event : events) {
    CHECK(std::string(event.name) == std::string(10, static_cast<char>('a' + event.value)));
  }
}

TEST_CASE("a trace file is whole or not there") {
  const bodice_test::TempFolder folder;
  Trace trace(4);
  Context context{.trace = &trace};
  trace_instant(context, "moment");
  REQUIRE(trace.write(folder / "trace.json").ok());
  std::ifstream file(folder / "trace.json");
  CHECK(std::string(std::istreambuf_iterator<char>(file), {}) == trace.json());
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
  const auto failed = trace.write(folder / "missing/trace.json");
  REQUIRE(!failed.ok());
  CHECK(failed.error().code == ErrorCode::kWriteFailed);
  CHECK(failed.error().message.find("trace.json") != std::string::npos);
}

TEST_CASE("stages are appended when they end, once each") {
  StepClock clock;
  Trace trace(4);
  Context context{.trace = &trace, .clock = &clock};
  std::vector<StageTime> stages;
  {
    StageTimer timer(context, stages, "load");
    timer.stop();
    timer.stop();
  }
  { StageTimer timer(context, stages, "fit"); }
  REQUIRE(stages.size() == 2);
  CHECK(stages[0].name == "load");
  CHECK(stages[0].ms == doctest::Approx(0.001));
  CHECK(stages[1].name == "fit");
  CHECK(trace.events().size() == 2);
}
