// The tables of one set of ellipsoids, at any size: what is asked of the skin is kept, so that another size
// costs a solve.
#pragma once

#include <memory>
#include <vector>

#include "plan/plan.hpp"
#include "relief/relief_terms.hpp"
#include "tiers/tiers.hpp"

namespace bodice::fitting {

class ReliefTables {
 public:
  /// Makes `data` (with its ellipsoids) a proxy of the relief tier; all arguments must outlive this.
  ReliefTables(const engine::Context& context, const SkinSource& source, proxy::BodyProxy::Data& data);

  /// Tables that are usable soon, and say where more texels pay. `bytes` as texels_within() takes them.
  void fit_first(std::size_t bytes);
  /// The tables that last, after fit_first. Some four times the samples, well under a second on two cores the
  /// first time, a third of that at every other size.
  void fit(std::size_t bytes);

 private:
  std::vector<ReliefSample> samples(const ReliefSampling& sampling, double spacing_m) const;
  ReliefAnswers ask(std::span<const ReliefSample> samples) const;
  ReliefAnswers ask_around(std::span<const std::uint32_t> leaks);

  const engine::Context& context_;
  FreeSkin skin_;
  proxy::BodyProxy::Data& data_;
  std::vector<double> error_;          ///< #E, of the first tables
  std::vector<ReliefSample> samples_;  ///< of fit(); empty before
  ReliefAnswers answers_;              ///< to them
};

/// The relief tier: tight ellipsoids, for half of a time budget, and their tables. Anytime: tells
/// options.on_improved of the first tables and leaves it at them once the budget is spent. With more
/// ellipsoids than tables fit (about 1000) the draft stays plain.
class ReliefRun {
 public:
  ReliefRun(const engine::Context& context, const LabeledSkin& skin, const FitOptions& options,
            const Plan& plan, std::vector<engine::StageTime>& stages);
  ReliefRun(const ReliefRun&) = delete;
  ReliefRun& operator=(const ReliefRun&) = delete;

  int count() const { return count_; }
  const Draft& draft() const { return draft_; }
  /// Tables of another size for the same ellipsoids.
  void resize(std::size_t bytes);

 private:
  /// What a fit of some regions only uses of the whole body's bytes.
  std::size_t share_of(std::size_t bytes) const;

  const engine::Context& context_;
  std::vector<engine::StageTime>& stages_;
  int count_;
  std::unique_ptr<SkinSource> source_;
  Draft draft_;
  std::unique_ptr<ReliefTables> tables_;  ///< null: no room for any
};

}  // namespace bodice::fitting
