#pragma once

#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::tryon {

/// Warns of landmarks around which most of the skin closes holes of the file, and names them. O(#V) a
/// landmark.
void warn_of_made_up(const io::ImportedMesh& mesh, const anatomy::Anatomy& anatomy,
                     std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
