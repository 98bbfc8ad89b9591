#pragma once

#include <bodice/fitting/fit.hpp>

namespace bodice::inline v0_1::fitting {

/// Rejects a skin or options that no proxy can be made from; the error names the element and the remedy.
engine::Result<void> check_input(const LabeledSkin& skin, const FitOptions& options);

/// The error for a skin without a triangle of the wanted parts.
engine::Error no_skin();

}  // namespace bodice::fitting
