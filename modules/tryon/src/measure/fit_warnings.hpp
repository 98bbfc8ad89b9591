// Warnings of garments that do not fit the body they were draped on.
#pragma once

#include <span>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/tryon/drape.hpp>

namespace bodice::inline v0_1::tryon {

/// A garment before and after its drape.
struct WornThen {
  const WornGarment& garment;
  std::span<const PartEase> start, end;       ///< how it lay, by part
  std::span<const geometry::Vec3> positions;  ///< #V at the end
  const geometry::Vec3& up;
  bool body_stood = true;  ///< whether the body stood still
};

/// Adds `too-tight` for the part where the garment is stretched beyond the fabric's limit most, with the
/// length around that is missing there, and `too-loose` for a garment that lay on the body and has slid down
/// it, with the distance.
void warn_of_fit(const WornThen& worn, const cloth::Fabric& fabric, std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
