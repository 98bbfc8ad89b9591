// The tables of one set of ellipsoids, at any size: what is asked of the skin is kept, so that another size
// costs a solve.
#pragma once

#include <vector>

#include "relief_answers.hpp"

namespace bodice::fitting {

class ReliefTables {
 public:
  /// Makes `data` (with its ellipsoids) a proxy of the relief tier; all arguments must outlive this.
  ReliefTables(const engine::Context& context, const SkinSource& source, proxy::BodyProxy::Data& data);

  /// Tables that are usable soon, and say where more texels pay. `bytes` as texels_within() takes them.
  void fit_first(std::size_t bytes);
  /// The tables that last, after fit_first. Fifteen times the samples, about a second on two cores the first
  /// time, a third of that at every other size.
  void fit(std::size_t bytes);

 private:
  ReliefAnswers ask(const ReliefSampling& sampling, double spacing_m) const;

  const engine::Context& context_;
  FreeSkin skin_;
  proxy::BodyProxy::Data& data_;
  std::vector<double> error_;  ///< #E, of the first tables
  ReliefAnswers answers_;      ///< to the samples of fit(); empty before
};

}  // namespace bodice::fitting
