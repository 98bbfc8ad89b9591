// What a scan may hide: folds under webs, landmarks beside holes, and a hand or foot that is not whole.
#pragma once

#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::tryon {

/// Warns where a scan, which has noise or a skin that was closed, may be wrong: all of armpits and crotch are
/// unlike those of known bodies, much of the skin around a landmark closes holes of the file, or a limb is
/// shorter than that of the other side. O(#V) a landmark.
void warn_of_scan(const io::ImportedMesh& mesh, const anatomy::Anatomy& anatomy,
                  std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
