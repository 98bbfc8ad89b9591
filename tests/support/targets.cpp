#include <bodice_test/targets.hpp>

#include <cstdint>

#include <hwy/targets.h>

namespace bodice_test {

void on_every_target(bodice::engine::FunctionRef<void(const std::string&)> body) {
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
