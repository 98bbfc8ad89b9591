// From landmarks to the 15 parts.
#pragma once

#include <bodice/body/part.hpp>

#include "landmarks.hpp"

namespace bodice::anatomy {

/// Every vertex gets a part; pieces other than the body take the part of the nearest skin. O(#V log #V).
std::vector<body::Part> segment(const engine::Context& context, const Skin& skin, const BodyEnds& ends,
                                const Landmarks& marks);

}  // namespace bodice::anatomy
