// The stature of a body with limbs that were cut apart and feet that are not level, such as in a stride.
#pragma once

#include <optional>

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// The height from the straight lengths between crown, neck, crotch, knees and ankles; empty where thighs are
/// bent. Webs change paths along the skin, but hardly these lengths: a crotch that is too low lengthens the
/// trunk as much as it shortens the thighs.
std::optional<double> upright_height(const Anatomy& found);

}  // namespace bodice::anatomy
