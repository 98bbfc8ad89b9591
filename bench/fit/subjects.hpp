// The bodies that are fitted, with points near their skin at which errors are judged.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <bodice/fitting/fit.hpp>

#include <bench_references/near_skin.hpp>
#include "arguments.hpp"
#include "labeled_body.hpp"

namespace fit_bench {

/// A body with its distances and probes.
struct Subject {
  std::string name;
  LabeledBody body;
  bodice::geometry::MeshDistance distance;
  std::vector<bench::Probe> probes;

  Subject(const bodice::engine::Context& context, std::string called, LabeledBody made);
  bodice::fitting::LabeledSkin skin() const { return {body.mesh, body.part, body.stature_m, {}, &distance}; }
};

/// Calls `each` with every body of the arguments, one at a time; false if a body cannot be read or `each` is
/// false.
bool for_each_subject(const bodice::engine::Context& context, const Arguments& arguments,
                      const std::function<bool(const Subject&)>& each);

/// Fits a subject; prints the error if that fails.
std::optional<bodice::fitting::FitResult> fitted(const bodice::engine::Context& context,
                                                 const Subject& subject,
                                                 const bodice::fitting::FitOptions& options);

/// Calls `take` with the fit of every subject, tier and count of the arguments; false if one fails.
bool for_each_fit(const bodice::engine::Context& context, const Arguments& arguments,
                  const std::function<void(const Subject&, int, const bodice::fitting::FitResult&)>& take);

/// Milliseconds of a stage of the fit, by its name.
double stage_ms(const bodice::fitting::FitResult& result, std::string_view name);

/// Milliseconds of all stages.
double total_ms(const bodice::fitting::FitResult& result);

}  // namespace fit_bench
