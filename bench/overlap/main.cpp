// How long do frames take while a body is prepared, and how long does the body take behind the frames?
#include <cstdio>
#include <fstream>

#include <CLI/CLI.hpp>

#include "measure.hpp"

using namespace bodice::engine;
using namespace bodice_bench;

namespace {

// All conditions. Each group begins with idle frames, to which the others of the group are compared.
std::vector<Condition> conditions(int workers, bool yields) {
  using enum BackgroundYield;
  const int spared = std::max(1, workers - 1);
  std::vector<Condition> all;
  for (const auto& [pace, frames_per_s] : {std::pair("60 Hz", 60.0), std::pair("no gaps", 0.0)}) {
    const std::string at(pace);
    all.push_back({at + ", idle", false, frames_per_s});
    all.push_back({at + ", fit in the foreground", true, frames_per_s, 0, kNone, true});
    if (yields) all.push_back({at + ", fit, background goes on", true, frames_per_s, 0, kNone});
    if (yields) all.push_back({at + ", fit, background helps a loop", true, frames_per_s, 0, kHelp});
    all.push_back({at + ", fit", true, frames_per_s});
    all.push_back({at + ", a worker spared, idle", false, frames_per_s, spared});
    all.push_back({at + ", a worker spared, fit", true, frames_per_s, spared});
  }
  return all;
}

/// A workload with a trace span for each block of its loops. Only the picture uses it, so that spans do not
/// slow the timed runs.
class TracedBlocks final : public Workload {
 public:
  explicit TracedBlocks(Workload& work, Executor& executor) : work_(work), executor_(executor) {}
  std::string describe() const override { return work_.describe(); }
  void frame(const Context& context) override {
    with_spans(context, "frame loop", [&](const Context& c) { work_.frame(c); });
  }
  Result<void> prepare(const Context& context, FunctionRef<void()> publish) const override {
    Result<void> result;
    with_spans(context, "background block", [&](const Context& c) { result = work_.prepare(c, publish); });
    return result;
  }

 private:
  class Spans final : public Executor {
   public:
    Spans(const Context& context, const char* name) : context_(context), name_(name) {}
    int concurrency() const noexcept override { return context_.executor->concurrency(); }
    void yield() noexcept override {}
    void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
      context_.executor->bulk(count, [&](std::size_t i) {
        context_.executor->yield();
        const TraceSpan span(context_, name_);
        body(i);
      });
    }

   private:
    Context context_;
    const char* name_;
  };
  template <class Call>
  static void with_spans(const Context& context, const char* name, Call&& call) {
    Spans spans(context, name);
    Context inner = context;
    inner.executor = &spans;
    call(inner);
  }
  Workload& work_;
  Executor& executor_;
};

void draw(Workload& work, Executor& executor, const std::string& svg_path, const std::string& trace_path) {
  Trace trace(1u << 20);
  TracedBlocks traced(work, executor);
  measure({"picture", true, 60.0}, traced, executor, 0.4, &trace);
  if (!svg_path.empty()) std::ofstream(svg_path) << timeline_svg(trace, "fit a body", 60.0);
  if (!trace_path.empty()) {
    if (const auto written = trace.write(trace_path); !written)
      std::fprintf(stderr, "%s\n", written.error().sentence().c_str());
  }
}

/// The command line, with its defaults.
struct Arguments {
  bool quick = false, picture_only = false, yields = false;
  int workers = 0;
  double slice_us = 200.0;
  int vertices = 0;
  std::string tier = "tight", csv, svg, trace;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_flag("--quick", a.quick, "Shorter runs");
  app.add_flag("--picture-only", a.picture_only, "No table, only --svg and --trace");
  app.add_flag("--yields", a.yields, "Also the other values of BackgroundYield");
  app.add_option("--workers", a.workers, "Workers, the caller included; 0: one a hardware thread");
  app.add_option("--slice-us", a.slice_us, "Length of a background block of the synthetic work");
  app.add_option("--body", a.vertices, "Real work: cloth frames, and fitting a body of so many vertices");
  app.add_option("--tier", a.tier, "Real work: the tier of the body's proxy")
      ->check(CLI::IsMember({"paper", "solid", "tight", "relief"}));
  app.add_option("--csv", a.csv, "Also write the rows to this file");
  app.add_option("--svg", a.svg, "Draw a timeline of 60 ms");
  app.add_option("--trace", a.trace, "Write the trace of the drawn run (Chrome trace events)");
}

/// Prints the table, a row for each condition. Returns it as CSV.
std::string print_table(Workload& work, Executor& executor, const Arguments& arguments) {
  const double foreground_ms = foreground_fit_ms(work, executor);
  std::printf("%s; %d workers\nfit alone, in the foreground: %.0f ms\n\n", work.describe().c_str(),
              executor.concurrency(), foreground_ms);
  std::printf(
      "| condition | frames | p50 ms | p99 ms | max ms | p99 / idle p99 | first result ms | last result ms | "
      "fit ms "
      "| fit / alone | others' load |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::string csv =
      "condition,workers,frames,p50_ms,p99_ms,max_ms,first_result_ms,last_result_ms,fit_ms,foreground_fit_ms,"
      "other_"
      "load\n";
  double idle_p99_ms = 0.0;
  for (const Condition& condition : conditions(executor.concurrency(), arguments.yields)) {
    const Row row = measure(condition, work, executor, arguments.quick ? 1.0 : 5.0, nullptr);
    if (!condition.fit) idle_p99_ms = row.p99_ms;
    std::printf("| %s | %zu | %.2f | %.2f | %.2f | %.2f |", row.name.c_str(), row.frames, row.p50_ms,
                row.p99_ms, row.max_ms, row.p99_ms / idle_p99_ms);
    if (condition.fit) {
      std::printf(" %.0f | %.0f | %.0f | %.2f |", row.first_result_ms, row.last_result_ms, row.fit_ms,
                  row.fit_ms / foreground_ms);
    } else {
      std::printf(" | | | |");
    }
    std::printf(" %.0f %% |\n", 100 * row.other_load);
    std::fflush(stdout);
    char line[256];
    std::snprintf(line, sizeof line, "\"%s\",%d,%zu,%.4f,%.4f,%.4f,%.2f,%.2f,%.2f,%.2f,%.3f\n",
                  row.name.c_str(), executor.concurrency(), row.frames, row.p50_ms, row.p99_ms, row.max_ms,
                  row.first_result_ms, row.last_result_ms, row.fit_ms, foreground_ms, row.other_load);
    csv += line;
  }
  return csv;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Frames beside preprocessing: frame times, and time until the first and the final result");
  add_options(app, arguments);
  CLI11_PARSE(app, argc, argv);
  const auto executor = make_tbb_executor(arguments.workers);
  const auto tier = bodice::proxy::tier_from_name(arguments.tier);
  const auto work =
      arguments.vertices > 0 ? make_body_work(arguments.vertices, *tier) : make_synthetic(arguments.slice_us);
  if (!arguments.picture_only) {
    const std::string csv = print_table(*work, *executor, arguments);
    if (!arguments.csv.empty()) std::ofstream(arguments.csv) << csv;
  }
  if (arguments.picture_only || !arguments.svg.empty() || !arguments.trace.empty())
    draw(*work, *executor, arguments.svg, arguments.trace);
  return 0;
}
