// Ends of the skin beside head, hands and feet: those of a second body, or of furniture.
#pragma once

#include <optional>
#include <string>

#include "extremities/body_extremities.hpp"

namespace bodice::inline v0_1::anatomy {

/// What contradicts a body if its skin reaches farther from all five extremities than a trunk does; empty if
/// it does not. `size_m`: the body size. O(#V).
std::optional<std::string> sixth_end_clause(const Skin& skin, const BodyExtremities& tips, float size_m);

}  // namespace bodice::anatomy
