// Warnings of a scan: of folds under webs, of landmarks beside holes, and of a hand or foot that is
// incomplete.
#pragma once

#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::tryon {

/// Warns of what may be wrong in a scan, that is, a skin with noise or closed holes. Folds: armpits and
/// crotch together look unlike those of known bodies. Landmarks: much of the skin around one closes holes of
/// the file. Limbs: one is shorter than that of the other side. O(#V) a landmark.
void warn_of_scan(const io::ImportedMesh& mesh, const anatomy::Anatomy& anatomy,
                  std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
