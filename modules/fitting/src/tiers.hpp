// One function a tier: each turns a labelled skin into ellipsoids.
#pragma once

#include <bodice/fitting/fit.hpp>

#include "allocate.hpp"
#include "skin_samples.hpp"

namespace bodice::fitting {

struct Draft {
  proxy::BodyProxy::Data data;
  Thresholds mu;
  bool thresholds_reached = true;
};

/// As written: vertices, k-means, enclosing ellipsoids.
Draft fit_paper(const engine::Context& context, const LabelledSkin& skin, const FitOptions& options,
                int count);

/// No leaks: whole triangles and interior points are clustered and enclosed, and what the union still misses
/// inside is added until nothing is.
Draft fit_solid(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                int count);

/// All ellipsoids optimised together against the exact signed distance, from medial clusters; anytime.
Draft fit_tight(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                int count, double time_budget_s);

/// Tables on top of a tight draft: a first version, then one from five times the samples unless the deadline
/// has passed. Leaves a draft with more ellipsoids than tables fit (about 1000) as it is.
void add_relief(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                std::int64_t deadline_ns, Draft& draft);

}  // namespace bodice::fitting
