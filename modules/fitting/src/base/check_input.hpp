#pragma once

#include <bodice/fitting/fit.hpp>

namespace bodice::fitting {

/// Rejects what no proxy can be made from, with the element and the remedy.
engine::Result<void> check_input(const LabeledSkin& skin, const FitOptions& options);

/// No triangle belongs to a wanted part.
engine::Error no_skin();

}  // namespace bodice::fitting
