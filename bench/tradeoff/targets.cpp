// Is what was asked for achieved, on bodies that nothing was developed on? Target errors and budgets of time.
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

constexpr double kWithin = 1.2;  // what the dial promises
constexpr double kFrameParticles = 1e4;
constexpr std::size_t kBudgetBodies = 5;  // what a count costs hardly depends on the body

/// All answers to one question.
struct Question {
  double asked = 0.0;  ///< mm, or microseconds
  std::vector<double> ratio, fit_ms, size, kilobytes;
  int met = 0;

  void add(double achieved, bool good, const Contender& chosen) {
    ratio.push_back(achieved / asked), fit_ms.push_back(chosen.prepare_ms);
    size.push_back(chosen.size), kilobytes.push_back(1e-3 * chosen.bytes);
    met += good;
  }
};

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

fitting::FitResult ask(const Setting& setting, const Subject& subject, const fitting::FitOptions& options) {
  return must(fitting::fit(setting.context, tryon::labeled(subject.skin), options));
}

bool missed_by_warning(const fitting::FitResult& fit) {
  return std::ranges::any_of(fit.warnings,
                             [](const engine::Warning& w) { return w.code == "target-error-not-reached"; });
}

void ask_for_error(const Setting& setting, const Subject& subject, Question& question, bench::Table& table) {
  const auto fit = ask(setting, subject, {.target_error_m = 1e-3 * question.asked});
  const double gap_mm = 1e3 * fit.accuracy.gap_m.mean, ratio = gap_mm / question.asked;
  const Contender c = of_proxy(subject, fit, "");
  const Error near = judge(c.distances_m(), subject.truth_m, true);
  const bool met = ratio <= kWithin && ratio >= 1.0 / kWithin;
  question.add(gap_mm, met, c);
  table.add({subject.name, question.asked, gap_mm, ratio, met ? "" : "missed",
             missed_by_warning(fit) ? "warned" : "", near.mean_mm, c.kind, c.size, c.bytes, fit_ms(fit)});
}

/// A proxy of a budget, which waits until all are there: timed one by one, each would be judged by the
/// minute that the machine has then.
struct Budgeted {
  std::string body;
  std::size_t question = 0;
  double gap_mm = 0.0;
};

void time_budgets(const std::vector<Budgeted>& asked, const std::vector<Contender>& contenders, int rounds,
                  std::vector<Question>& questions, bench::Table& table) {
  const std::vector<Cost> costs = time_all(contenders, rounds);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Contender& c = contenders[i];
    Question& question = questions[asked[i].question];
    const double us = 1e-3 * kFrameParticles * costs[i].query_ns;
    question.add(us, us <= kWithin * question.asked, c);
    table.add({asked[i].body, question.asked, c.kind, c.size, asked[i].gap_mm, us, us / question.asked,
               1e-3 * kFrameParticles * costs[i].response_ns});
  }
}

bench::Table summary(const char* name, const char* caption, const char* asked, const std::string& timed,
                     const std::vector<Question>& questions) {
  bench::Table table(name, caption,
                     {asked, "bodies", "met" + timed, "least_ratio" + timed, "median_ratio" + timed,
                      "largest_ratio" + timed, "median_ellipsoids", "median_KB", "median_fit_ms"});
  for (const Question& q : questions) {
    if (q.ratio.empty()) continue;
    table.add({q.asked, q.ratio.size(), q.met, std::ranges::min(q.ratio), middle(q.ratio),
               std::ranges::max(q.ratio), middle(q.size), middle(q.kilobytes), middle(q.fit_ms)});
  }
  return table;
}

std::vector<Question> questions(const std::vector<double>& asked) {
  std::vector<Question> all;
  for (const double value : asked) all.push_back({.asked = value});
  return all;
}

std::vector<SubjectSource> unseen_bodies(const Setting& setting) {
  constexpr std::uint64_t kFirstSeed = 1000;  // apart from every seed of the tests
  auto sources = made_bodies(kFirstSeed, setting.bodies(1, 2, 20), setting.by_effort(1500, 3000, 4500));
  if (setting.data.empty()) return sources;
  for (SubjectSource& file : bodies_of(setting.data)) sources.push_back(std::move(file));
  return sources;
}

}  // namespace

Findings sweep_dials(const Setting& setting) {
  auto errors = questions(
      setting.by_effort<std::vector<double>>({5.0}, {0.5, 2.0, 10.0}, {0.5, 1.0, 2.0, 5.0, 10.0, 20.0}));
  auto budgets = questions(
      setting.by_effort<std::vector<double>>({100.0}, {100.0, 300.0}, {100.0, 150.0, 300.0, 600.0}));
  bench::Table by_error("dial_error_by_body", "Asked and achieved mean gap.",
                        {"body", "asked_mm", "achieved_mm", "ratio", "missed", "warned", "near_skin_mean_mm",
                         "tier", "ellipsoids", "bytes", "fit_ms"});
  bench::Table by_time("dial_budget_by_body", "Asked and measured time of 10,000 particles.",
                       {"body", "asked_us_of_10000_particles", "tier", "ellipsoids", "gap_mean_mm",
                        "query_us", "ratio_timed", "response_us"});
  std::vector<Budgeted> asked;
  std::vector<Contender> budgeted;
  const auto sources = unseen_bodies(setting);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Subject subject = sources[i].make(setting.context);
    for (Question& q : errors) {
      progress("dials", subject.name + ", " + std::to_string(q.asked) + " mm");
      ask_for_error(setting, subject, q, by_error);
    }
    if (i >= kBudgetBodies) continue;
    for (std::size_t k = 0; k < budgets.size(); ++k) {
      progress("dials", subject.name + ", " + std::to_string(budgets[k].asked) + " us");
      const auto fit = ask(setting, subject, {.budget_us = budgets[k].asked});
      asked.push_back({subject.name, k, 1e3 * fit.accuracy.gap_m.mean});
      budgeted.push_back(of_proxy(subject, fit, ""));
    }
  }
  progress("dials", "timing");
  time_budgets(asked, budgeted, setting.by_effort(3, 30, 100), budgets, by_time);
  Findings found;
  found.text =
      "Bodies of seeds that no test and no constant was developed on, then those of the folder; a target is "
      "met within a fifth above or below, a budget a fifth above at most (query, one thread, a body's "
      "particles in Morton order).\n";
  found.shown.push_back(
      summary("dial_error", "Mean gap achieved over asked, `--target-error-mm`.", "asked_mm", "", errors));
  found.shown.push_back(summary("dial_budget", "Time measured over asked, `--budget-us`.",
                                "asked_us_of_10000_particles", "_timed", budgets));
  found.details.push_back(std::move(by_error));
  found.details.push_back(std::move(by_time));
  return found;
}

}  // namespace tradeoff
