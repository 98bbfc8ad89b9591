// Whether the options of a drape are in their ranges.
#pragma once

#include <bodice/tryon/drape.hpp>

namespace bodice::inline v0_1::tryon {

/// Fails with kInvalidArgument, naming the option and its range.
engine::Result<void> check(const DrapeOptions& options, const PreparedBody& body);

}  // namespace bodice::tryon
