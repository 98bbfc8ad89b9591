// The front of error against cost: every tier with its counts and tables, beside the peers, on the same
// particles.
#include <algorithm>
#include <string>

#include "contender.hpp"
#include "judge.hpp"
#include "levels.hpp"
#include "must.hpp"
#include "pareto.hpp"
#include "sweep.hpp"

namespace tradeoff {
namespace {

using namespace bodice;
using proxy::Tier;

constexpr double kExact_mm = 0.05;  ///< plots draw smaller errors at this value

/// The options of a fit: a count or, for relief, a target error that decides the size of the tables.
struct FitSetting {
  Tier tier;
  int count = 89;
  double target_mm = 0.0;

  std::string label() const {
    if (target_mm == 0.0) return std::to_string(count);
    return "target 0." + std::to_string(static_cast<int>(1e2 * target_mm + 0.5)) + " mm";
  }
  fitting::FitOptions options() const {
    fitting::FitOptions o{.tier = tier, .max_ellipsoids = count};
    if (target_mm > 0.0) o.target_error_m = 1e-3 * target_mm;
    return o;
  }
};

std::vector<FitSetting> fit_settings(const Setting& setting) {
  if (setting.effort == Effort::kSmallest) return {{Tier::kPaper}, {Tier::kSolid, 30}, {Tier::kTight, 15}};
  if (setting.effort == Effort::kQuick)
    return {{Tier::kPaper},     {Tier::kSolid, 15}, {Tier::kSolid},     {Tier::kTight, 15},
            {Tier::kTight, 30}, {Tier::kTight},     {Tier::kRelief, 32}};
  std::vector<FitSetting> all;
  for (const int count : {15, 30, 55, 89, 200}) all.push_back({Tier::kPaper, count});
  for (const int count : {15, 30, 55, 89, 200, 400}) all.push_back({Tier::kSolid, count});
  for (const int count : {5, 8, 15, 22, 30, 55, 89, 160, 300}) all.push_back({Tier::kTight, count});
  for (const int count : {16, 32, 55, 89}) all.push_back({Tier::kRelief, count});
  for (const double mm : {0.25, 0.4}) all.push_back({Tier::kRelief, 89, mm});
  return all;
}

/// One contender over all bodies.
struct Row {
  std::string kind, setting;
  bool ours = false;
  std::vector<Error> errors;
  double size = 0.0, bytes = 0.0, prepare_ms = 0.0, update_us = 0.0, query_ns = 0.0, response_ns = 0.0;

  void divide(double by) {
    for (double* sum : {&size, &bytes, &prepare_ms, &update_us, &query_ns, &response_ns}) *sum /= by;
  }
};

std::vector<Contender> contenders_of(const Setting& setting, const Subject& subject) {
  std::vector<Contender> all;
  for (const FitSetting& chosen : fit_settings(setting)) {
    progress("front", subject.name + ", " + std::string(proxy::name(chosen.tier)) + " " + chosen.label());
    const auto fit = must(fitting::fit(setting.context, tryon::labeled(subject.skin), chosen.options()));
    all.push_back(of_proxy(subject, fit, chosen.label()));
    if (chosen.tier == Tier::kTight || chosen.tier == Tier::kRelief)
      all.push_back(of_proxy(subject, fit, chosen.label(), collision::Accuracy::kFirstOrder));
  }
  progress("front", subject.name + ", peers");
  const auto cells = setting.by_effort<std::vector<double>>({0.04}, {0.04, 0.02}, {0.04, 0.02, 0.01, 0.005});
  for (Contender& peer : peers(subject, cells)) all.push_back(std::move(peer));
  return all;
}

bench::Table table_by_body() {
  return {"front_by_body",
          "Every setting on every body.",
          {"body", "kind", "setting", "size", "bytes", "mean_mm", "p95_mm", "max_mm", "missed_percent",
           "false_percent", "prepare_ms", "update_us", "query_ns", "response_ns"}};
}

void judge_body(const Setting& setting, const Subject& subject, std::vector<Row>& rows, bench::Table& table) {
  auto all = contenders_of(setting, subject);
  const std::vector<Cost> costs = time_all(all, setting.by_effort(1, 5, 11));
  rows.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Contender& c = all[i];
    const Error e = judge(c.distances_m(), subject.truth_m, c.has_sign);
    table.add({subject.name, c.kind, c.setting, c.size, c.bytes, e.mean_mm, e.p95_mm, e.max_mm,
               e.missed_percent, e.false_percent, c.prepare_ms, c.update_us, costs[i].query_ns,
               costs[i].response_ns});
    Row& row = rows[i];
    row.kind = c.kind, row.setting = c.setting, row.ours = c.ours;
    row.errors.push_back(e);
    row.size += c.size, row.bytes += c.bytes, row.prepare_ms += c.prepare_ms, row.update_us += c.update_us;
    row.query_ns += costs[i].query_ns, row.response_ns += costs[i].response_ns;
  }
}

bench::Table table_of(const std::vector<Row>& rows, const std::vector<bool>& by_time,
                      const std::vector<bool>& by_bytes) {
  bench::Table table(
      "front", "Means over the bodies.",
      {"kind", "setting", "size", "KB", "mean_mm", "p95_mm", "max_mm", "missed_%", "false_%", "prepare_ms",
       "update_us", "query_ns", "response_ns", "on_front_of_memory", "on_front_of_time_timed"});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& r = rows[i];
    const Error e = mean_of(r.errors);
    const auto known = [](double value) { return value > 0.0 ? bench::Cell(value) : bench::Cell(); };
    table.add({r.kind, r.setting, known(r.size), known(1e-3 * r.bytes), e.mean_mm, e.p95_mm, e.max_mm,
               e.missed_percent, e.false_percent, r.prepare_ms, r.update_us, r.query_ns, known(r.response_ns),
               by_bytes[i] ? "yes" : "", by_time[i] ? "yes" : ""});
  }
  return table;
}

bench::Plot plot_of(const std::vector<Row>& rows, const char* title, const char* label,
                    double (*cost)(const Row&)) {
  bench::Plot plot{title, label, "mean error of the signed distance within 30 mm of the skin, mm", "", {}};
  for (const Row& row : rows) {
    // Relief with smaller tables and relief with fewer ellipsoids are separate lines.
    const bool is_target = row.setting.starts_with("target");
    const std::string name = is_target ? row.kind + ", target" : row.kind;
    auto at = std::ranges::find(plot.series, name, &bench::PlotSeries::name);
    if (at == plot.series.end()) at = plot.series.insert(at, {name, {}, row.ours, !row.ours});
    const double error_mm = mean_of(row.errors).mean_mm;
    const std::string text = is_target ? row.setting.substr(sizeof "target") : row.setting;
    at->points.push_back(
        {cost(row), std::max(kExact_mm, error_mm), error_mm < kExact_mm ? text + ": 0" : text});
  }
  return plot;
}

double moving_frame_us(const Row& row) {
  return row.update_us + 1e-3 * kFrameParticles * row.query_ns;
}

}  // namespace

Findings sweep_front(const Setting& setting) {
  auto sources = made_bodies(0, setting.bodies(1, 1, 3), setting.vertices());
  if (!setting.data.empty()) {
    const auto files = bodies_of(setting.data);
    for (std::size_t i = 0; i < files.size(); i += std::max<std::size_t>(1, files.size() / 3))
      sources.push_back(files[i]);
  }
  std::vector<Row> rows;
  Findings found;
  found.details.push_back(table_by_body());
  for (const SubjectSource& source : sources)
    judge_body(setting, source.make(setting.context), rows, found.details[0]);

  std::vector<Offer> by_time, by_frame, by_bytes;
  std::vector<bool> ours;
  std::vector<std::string> names;
  for (Row& row : rows) {
    row.divide(static_cast<double>(sources.size()));
    const double error = mean_of(row.errors).mean_mm;
    by_time.push_back({row.query_ns, error});
    by_frame.push_back({moving_frame_us(row), error});
    by_bytes.push_back({row.bytes, error});
    ours.push_back(row.ours);
    names.push_back(row.kind + " " + row.setting);
  }
  found.text =
      "Particles spread evenly over depths up to 30 mm on either side of the skin, in Morton order, one "
      "thread. Errors are against the exact signed distance (of Embree, which has no sign, against its "
      "absolute "
      "value). Peers give a distance; proxies give the closest point, the normal and the ellipsoid as well. "
      "'To first "
      "order' is the same proxy with Accuracy::kFirstOrder. `prepare` starts from the segmented skin. "
      "`update` is the "
      "time a frame for a moving body: ellipsoids and capsules move rigidly with their part, Embree and the "
      "grids are "
      "built anew and stay exact (a refit of Embree would take about a tenth of that). A row is on a front "
      "if no "
      "other row has both a smaller error and a smaller cost.\n";
  found.shown.push_back(table_of(rows, on_front(by_time), on_front(by_bytes)));
  found.shown.push_back(levels_by_time(names, by_time, ours));
  found.shown.push_back(levels_by_moving_frame(names, by_frame, ours));
  found.shown.push_back(levels_by_bytes(names, by_bytes, ours));
  found.plots.emplace_back(
      "front_time", plot_of(rows, "Error against time, the body at rest (labels: ellipsoids, target or cell)",
                            "query, ns a particle", [](const Row& r) { return r.query_ns; }));
  found.plots.emplace_back(
      "front_moving",
      plot_of(rows, "Error against time, the body in motion (labels: ellipsoids, target or cell)",
              "update and 10,000 queries, microseconds", moving_frame_us));
  found.plots.emplace_back("front_bytes",
                           plot_of(rows, "Error against memory (labels: ellipsoids, target or cell)", "bytes",
                                   [](const Row& r) { return r.bytes; }));
  found.plots.emplace_back("front_fit",
                           plot_of(rows, "Error against preparation (labels: ellipsoids, target or cell)",
                                   "preparation, ms", [](const Row& r) { return r.prepare_ms; }));
  return found;
}

}  // namespace tradeoff
