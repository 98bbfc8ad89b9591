// Are target errors and time budgets reached, on bodies from which no constant was derived?
#include <algorithm>
#include <cmath>
#include <optional>

#include "contender.hpp"
#include "judge.hpp"
#include "must.hpp"
#include "sweep.hpp"

namespace tradeoff {
namespace {

using namespace bodice;

constexpr double kWithin = 1.2;           // a target is met within this factor
constexpr std::size_t kBudgetBodies = 5;  // the time of a query hardly depends on the body

/// The fits of all bodies for one target or budget.
struct Target {
  double requested = 0.0;  ///< mm, or microseconds
  std::vector<double> ratio, fit_ms, size, kilobytes;
  int met = 0;

  void add(double achieved, bool good, const Contender& chosen) {
    ratio.push_back(achieved / requested), fit_ms.push_back(chosen.prepare_ms);
    size.push_back(chosen.size), kilobytes.push_back(1e-3 * chosen.bytes);
    met += good;
  }
};

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

fitting::FitResult fit(const Setting& setting, const Subject& subject, const fitting::FitOptions& options) {
  return must(fitting::fit(setting.context, tryon::labeled(subject.skin), options));
}

bool missed_by_warning(const fitting::FitResult& fit) {
  return std::ranges::any_of(fit.warnings,
                             [](const engine::Warning& w) { return w.code == "target-error-not-reached"; });
}

void add_error(const Setting& setting, const Subject& subject, Target& target, bench::Table& table) {
  const auto found = fit(setting, subject, {.target_error_m = 1e-3 * target.requested});
  const double gap_mm = 1e3 * found.accuracy.gap_m.mean, ratio = gap_mm / target.requested;
  const Contender c = of_proxy(subject, found, "");
  const Error near = judge(c.distances_m(), subject.truth_m, true);
  const bool met = ratio <= kWithin && ratio >= 1.0 / kWithin;
  target.add(gap_mm, met, c);
  table.add({subject.name, target.requested, gap_mm, ratio, met ? "" : "missed",
             missed_by_warning(found) ? "warned" : "", near.mean_mm, c.kind, c.size, c.bytes, fit_ms(found)});
}

/// The fit of a budget. All are timed together at the end, because the speed of the machine varies from
/// minute to minute.
struct Budgeted {
  std::string body;
  std::size_t budget = 0;  ///< index of its Target
  double gap_mm = 0.0;
};

void time_budgets(const std::vector<Budgeted>& fits, const std::vector<Contender>& contenders, int rounds,
                  std::vector<Target>& budgets, bench::Table& table) {
  const std::vector<Cost> costs = time_all(contenders, rounds);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Contender& c = contenders[i];
    Target& budget = budgets[fits[i].budget];
    const double us = 1e-3 * kFrameParticles * costs[i].query_ns;
    budget.add(us, us <= kWithin * budget.requested, c);
    table.add({fits[i].body, budget.requested, c.kind, c.size, fits[i].gap_mm, us, us / budget.requested,
               1e-3 * kFrameParticles * costs[i].response_ns});
  }
}

bench::Table summary(const char* name, const char* caption, const char* requested, const std::string& timed,
                     const std::vector<Target>& targets) {
  bench::Table table(name, caption,
                     {requested, "bodies", "met" + timed, "least_ratio" + timed, "median_ratio" + timed,
                      "largest_ratio" + timed, "median_ellipsoids", "median_KB", "median_fit_ms"});
  for (const Target& t : targets) {
    if (t.ratio.empty()) continue;
    table.add({t.requested, t.ratio.size(), t.met, std::ranges::min(t.ratio), middle(t.ratio),
               std::ranges::max(t.ratio), middle(t.size), middle(t.kilobytes), middle(t.fit_ms)});
  }
  return table;
}

std::vector<Target> targets(const std::vector<double>& requested) {
  std::vector<Target> all;
  for (const double value : requested) all.push_back({.requested = value});
  return all;
}

std::vector<SubjectSource> unseen_bodies(const Setting& setting) {
  constexpr std::uint64_t kFirstSeed = 1000;  // no test uses these seeds
  auto sources = made_bodies(kFirstSeed, setting.bodies(1, 2, 20), setting.by_effort(1500, 3000, 4500));
  if (setting.data.empty()) return sources;
  for (SubjectSource& file : bodies_of(setting.data)) sources.push_back(std::move(file));
  return sources;
}

}  // namespace

Findings sweep_targets(const Setting& setting) {
  auto errors = targets(
      setting.by_effort<std::vector<double>>({5.0}, {0.5, 2.0, 10.0}, {0.5, 1.0, 2.0, 5.0, 10.0, 20.0}));
  auto budgets =
      targets(setting.by_effort<std::vector<double>>({100.0}, {100.0, 300.0}, {100.0, 150.0, 300.0, 600.0}));
  bench::Table by_error("target_error_by_body", "Requested and achieved mean gap.",
                        {"body", "requested_mm", "achieved_mm", "ratio", "missed", "warned",
                         "near_skin_mean_mm", "tier", "ellipsoids", "bytes", "fit_ms"});
  bench::Table by_time("budget_by_body", "Requested and measured time of 10,000 particles.",
                       {"body", "requested_us_of_10000_particles", "tier", "ellipsoids", "gap_mean_mm",
                        "query_us", "ratio_timed", "response_us"});
  std::vector<Budgeted> budget_fits;
  std::vector<Contender> budgeted;
  const auto sources = unseen_bodies(setting);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Subject subject = sources[i].make(setting.context);
    for (Target& target : errors) {
      progress("targets", subject.name + ", " + std::to_string(target.requested) + " mm");
      add_error(setting, subject, target, by_error);
    }
    if (i >= kBudgetBodies) continue;
    for (std::size_t k = 0; k < budgets.size(); ++k) {
      progress("targets", subject.name + ", " + std::to_string(budgets[k].requested) + " us");
      const auto found = fit(setting, subject, {.budget_us = budgets[k].requested});
      budget_fits.push_back({subject.name, k, 1e3 * found.accuracy.gap_m.mean});
      budgeted.push_back(of_proxy(subject, found, ""));
    }
  }
  progress("targets", "timing");
  time_budgets(budget_fits, budgeted, setting.by_effort(3, 30, 100), budgets, by_time);
  Findings found;
  found.text =
      "The bodies have seeds that no test and no constant was made with; those of the folder follow. A "
      "target is "
      "met within a fifth above or below, a budget up to a fifth above (query, one thread, a body's "
      "particles in "
      "Morton order).\n";
  found.shown.push_back(summary("target_error", "Mean gap achieved over requested, `--target-error-mm`.",
                                "requested_mm", "", errors));
  found.shown.push_back(summary("budget", "Time measured over requested, `--budget-us`.",
                                "requested_us_of_10000_particles", "_timed", budgets));
  found.details.push_back(std::move(by_error));
  found.details.push_back(std::move(by_time));
  return found;
}

}  // namespace tradeoff
