#include "subjects.hpp"

#include <cstdio>

namespace fit_bench {

using namespace bodice;

Subject::Subject(const engine::Context& context, std::string called, LabeledBody made)
    : name(std::move(called)),
      body(std::move(made)),
      distance(context, body.mesh),
      probes(bench::near_skin_probes(context, body.mesh, distance)) {}

bool for_each_subject(const engine::Context& context, const Arguments& arguments,
                      const std::function<bool(const Subject&)>& each) {
  const auto& data = arguments.data;
  for (const std::string& name : arguments.bodies) {
    const auto own_labels = data / (name + ".labels.txt");
    auto body = load(data / (name + ".obj"),
                     exists(own_labels) ? own_labels : data / "labels/makehuman13380.labels.txt");
    if (!body) {
      std::fprintf(stderr, "fit: cannot read %s and its labels\n", name.c_str());
      return false;
    }
    if (!each(Subject(context, name, std::move(*body)))) return false;
  }
  for (const int seed : arguments.seeds) {
    auto body = make_synthetic(static_cast<std::uint64_t>(seed));
    if (!body || !each(Subject(context, "synth_" + std::to_string(seed), std::move(*body)))) return false;
  }
  return true;
}

std::optional<fitting::FitResult> fitted(const engine::Context& context, const Subject& subject,
                                         const fitting::FitOptions& options) {
  auto result = fitting::fit(context, subject.skin(), options);
  if (result) return std::move(*result);
  std::fprintf(stderr, "fit: %s\n", result.error().sentence().c_str());
  return std::nullopt;
}

bool for_each_fit(const engine::Context& context, const Arguments& arguments,
                  const std::function<void(const Subject&, int, const fitting::FitResult&)>& take) {
  return for_each_subject(context, arguments, [&](const Subject& subject) {
    for (const proxy::Tier tier : arguments.tiers)
      for (const int count : arguments.counts) {
        fitting::FitOptions options;
        options.tier = tier;
        options.max_ellipsoids = count;
        options.time_budget_s = arguments.seconds;
        const auto result = fitted(context, subject, options);
        if (!result) return false;
        take(subject, count, *result);
      }
    return true;
  });
}

double stage_ms(const fitting::FitResult& result, std::string_view name) {
  double ms = 0.0;
  for (const auto& stage : result.stages)
    if (stage.name == name) ms += stage.ms;
  return ms;
}

double total_ms(const fitting::FitResult& result) {
  double ms = 0.0;
  for (const auto& stage : result.stages) ms += stage.ms;
  return ms;
}

}  // namespace fit_bench
