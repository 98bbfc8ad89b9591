// The height of a body that need not stand.
#pragma once

#include "landmarks/base/landmarks.hpp"

namespace bodice::anatomy {

/// The height of the body as if it stood, in the mesh's unit: from sole to crown if it stands, else from
/// distances along the skin, within about 2 % (one deviation).
double find_stature(const Skin& skin, const BodyExtremities& tips, const Landmarks& marks);

}  // namespace bodice::anatomy
