#pragma once

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::tryon {

/// Corrects an up axis that was found by the extents of a file. A sitting body is about as wide as it is
/// tall, so that its trunk and legs are better evidence. Where the trunk stands along another axis of the
/// file, and no lower leg contradicts, turns skin, landmarks and frame, and returns true. Turns by right
/// angles are exact.
bool stand_upright(io::ImportedMesh& mesh, anatomy::Anatomy& anatomy);

}  // namespace bodice::tryon
