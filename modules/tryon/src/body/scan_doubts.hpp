// What a scan may hide: folds under webs, landmarks beside holes, and a hand or foot that is not whole.
#pragma once

#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::tryon {

/// Warns of a scan, which has noise or a skin that was closed: of armpits and a crotch that are unlike those
/// of known bodies; of landmarks around which much of the skin closes holes of the file; and of limbs that
/// are shorter than those of the other side. O(#V) a landmark.
void warn_of_scan(const io::ImportedMesh& mesh, const anatomy::Anatomy& anatomy,
                  std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
