#pragma once

#include <bodice/cloth/solver.hpp>

namespace bodice::inline v0_1::cloth {

/// Fails with kInvalidArgument if a value is not finite or out of range.
engine::Result<void> check(const Environment& environment);
/// Fails with kInvalidArgument, naming the option and its range.
engine::Result<void> check(const SolverOptions& options);

}  // namespace bodice::cloth
