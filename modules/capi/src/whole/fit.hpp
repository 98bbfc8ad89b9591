// Fits of the C interface.
#pragma once

#include <bodice/tryon/prepare.hpp>

#include "base/outcome.hpp"
#include "whole/progress.hpp"

namespace bodice::inline v0_1::capi {

/// The engine's tier of a number of the interface; -1 leaves `out` empty.
Outcome read_tier(std::int32_t tier, const char* name, std::optional<proxy::Tier>& out);
/// Checks the options of a fit and converts them.
Outcome read_fit(const bodice_fit_options& given, fitting::FitOptions& out);

/// The results of a fit that the host receives.
struct Fitted {
  std::optional<proxy::BodyProxy> proxy;
  bodice_fit_report report;
};

/// Fits, and binds if the skin has a rig and `bind` is set.
Outcome make_fit(Progress& progress, const tryon::SegmentedSkin& skin, const fitting::FitOptions& options,
                 bool bind, Fitted& out);

}  // namespace bodice::capi
