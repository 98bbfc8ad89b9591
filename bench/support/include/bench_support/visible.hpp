#pragma once

namespace bench {

/// Cloth that lies deeper in the skin than this, meters, shows it.
inline constexpr double kVisible_m = 0.5e-3;

}  // namespace bench
