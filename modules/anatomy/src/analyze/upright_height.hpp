// The height of a body that was cut apart and does not stand level, such as in a stride.
#pragma once

#include <optional>

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// The height by the straight lengths from crown to neck, crotch, knees and ankles; empty where thighs are
/// bent. Webs change paths along the skin, and hardly these: what a crotch too low adds to the trunk is
/// missing from the thighs.
std::optional<double> upright_height(const Anatomy& found);

}  // namespace bodice::anatomy
