#pragma once

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::tryon {

/// The trunk and the legs give a better up axis than extents alone, by which a file's was found: a body that
/// sits with z up is as wide as it is tall. Turns skin, landmarks and frame, and returns true, where the
/// trunk stands along another axis of the file and no lower leg contradicts. Turns are exact.
bool stand_upright(io::ImportedMesh& mesh, anatomy::Anatomy& anatomy);

}  // namespace bodice::tryon
