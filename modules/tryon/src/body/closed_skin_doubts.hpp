// What a skin that was closed may hide: landmarks beside holes, and a hand or foot that is not whole.
#pragma once

#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::tryon {

/// Warns of landmarks around which much of the skin closes holes of the file, and of limbs that are shorter
/// than those of the other side, and names them. Nothing if the skin was not closed. O(#V) a landmark.
void warn_of_closed_skin(const io::ImportedMesh& mesh, const anatomy::Anatomy& anatomy,
                         std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
