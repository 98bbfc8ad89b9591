#pragma once

#include "landmarks/landmarks.hpp"

namespace bodice::anatomy {

/// The height of the body as if it stood, in the mesh's unit. Of a body that stands, from sole to crown; of
/// any other, from distances along the skin, within about 2 % (one deviation).
double find_stature(const Skin& skin, const BodyExtremities& ends, const Landmarks& marks);

}  // namespace bodice::anatomy
