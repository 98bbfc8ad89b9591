// Questions about isolines on the skin.
#pragma once

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// +1 if the loop runs counter-clockwise seen from the side where `rising` grows, with the outside outward.
double turning(const Skin& skin, const geodesic::Isoline& loop, std::span<const float> rising);

/// The field at a point of the loop, between the ends of its edge.
float value_at(const Skin& skin, const geodesic::Isoline& loop, std::size_t point,
               std::span<const float> field);

/// The closed curve of the greatest girth, or null.
const geodesic::Isoline* widest_closed(const std::vector<geodesic::Isoline>& lines);

}  // namespace bodice::anatomy
