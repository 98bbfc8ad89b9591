#pragma once

#include <bodice/fitting/fit.hpp>

namespace bodice::fitting {

/// Rejects what no proxy can be made from, with the element and the remedy.
engine::Result<void> check_input(const LabelledSkin& skin, const FitOptions& options);

}  // namespace bodice::fitting
