#pragma once

#include <bodice/cloth/solver.hpp>

namespace bodice::cloth {

/// Each fails with kInvalidArgument, naming the option and the range.
engine::Result<void> check(const Environment& environment);
engine::Result<void> check(const SolverOptions& options);

}  // namespace bodice::cloth
