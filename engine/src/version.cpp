#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine::layout {

void BODICE_LAYOUT() noexcept {}

}  // namespace bodice::inline v0_1::engine::layout
