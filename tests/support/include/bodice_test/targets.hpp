// Runs a test on every instruction set of this machine.
#pragma once

#include <cstdint>
#include <string>

#include <hwy/targets.h>

namespace bodice_test {

/// Calls `body` (name of the instruction set) once for every instruction set of this machine.
template <class Body>
void on_every_target(Body&& body) {
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    body(std::string(hwy::TargetName(target)));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace bodice_test
