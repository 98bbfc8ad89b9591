// As many floats as a bundle has nodes, in loops that become vector code.
#pragma once

#include <bodice/proxy/binding.hpp>

namespace bodice::binding {

inline constexpr int kLanes = proxy::kBundle;
using Lanes = float[kLanes];

}  // namespace bodice::binding
