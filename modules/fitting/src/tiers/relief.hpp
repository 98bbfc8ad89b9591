// The tables of one set of ellipsoids. Samples and their terms are kept, so that tables of another size cost
// only another solution of the system.
#pragma once

#include <memory>
#include <vector>

#include "plan/plan.hpp"
#include "relief/relief_terms.hpp"
#include "tiers/tiers.hpp"

namespace bodice::inline v0_1::fitting {

/// Makes the tables of a proxy at any size.
class ReliefTables {
 public:
  /// Turns `data`, which has ellipsoids, into a proxy of tier relief. All arguments must outlive this object.
  ReliefTables(const engine::Context& context, const SkinSource& source, proxy::BodyProxy::Data& data);

  /// Makes first tables, which are there soon and show where more texels pay. `bytes` is as in
  /// texels_within().
  void fit_first(std::size_t bytes);
  /// Makes the final tables, after fit_first(), from about four times the samples: well under a second on two
  /// cores the first time, and a third of that for every other size.
  void fit(std::size_t bytes);

 private:
  std::vector<ReliefSample> samples(const ReliefSampling& sampling, double spacing_m) const;
  ReliefTerms terms_of(std::span<const ReliefSample> samples) const;
  ReliefTerms terms_around(std::span<const std::uint32_t> leaks);

  const engine::Context& context_;
  FreeSkin skin_;
  proxy::BodyProxy::Data& data_;
  std::vector<double> error_;          ///< #E, left by the first tables
  std::vector<ReliefSample> samples_;  ///< those of fit(); empty before the first call
  ReliefTerms terms_;                  ///< of samples_
};

/// Tier relief: tight ellipsoids, in half of a time budget, and their tables. It is an anytime task: it
/// publishes the first tables to options.on_improved and stops with them once the budget is spent. With too
/// many ellipsoids for tables to fit (about 1000) the draft stays plain.
class ReliefRun {
 public:
  ReliefRun(const engine::Context& context, const LabeledSkin& skin, const FitOptions& options,
            const Plan& plan, std::vector<engine::StageTime>& stages);
  ReliefRun(const ReliefRun&) = delete;
  ReliefRun& operator=(const ReliefRun&) = delete;

  int count() const { return count_; }
  const Draft& draft() const { return draft_; }
  /// Makes tables of another size for the same ellipsoids.
  void resize(std::size_t bytes);

 private:
  /// The share of the whole body's bytes that a fit of some regions uses.
  std::size_t share_of(std::size_t bytes) const;

  const engine::Context& context_;
  std::vector<engine::StageTime>& stages_;
  int count_;
  std::unique_ptr<SkinSource> source_;
  Draft draft_;
  std::unique_ptr<ReliefTables> tables_;  ///< null: there is no room for tables
};

}  // namespace bodice::fitting
