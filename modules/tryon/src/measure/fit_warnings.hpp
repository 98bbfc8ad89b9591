// Warnings of garments that do not fit the body they were draped on.
#pragma once

#include <span>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/tryon/drape.hpp>

namespace bodice::inline v0_1::tryon {

/// A garment before and after its drape.
struct GarmentBeforeAndAfter {
  const WornGarment& garment;
  std::span<const PartEase> start, end;       ///< ease at the start and at the end, by part
  std::span<const geometry::Vec3> positions;  ///< #V at the end
  const geometry::Vec3& up;
  bool body_stood = true;  ///< whether the body stood still
};

/// Adds the warnings of a garment that does not fit. `too-tight` names each part around which the garment is
/// at least 1 cm too short for its fabric, with that length, the tightest part first. `caught` names those
/// that a moving body has stretched by 40 % more than the fabric yields, which no size mends. `too-loose` is
/// for a garment that lay on the body and has slid down it by more than 5 cm on average, and states that
/// distance.
void warn_of_fit(const GarmentBeforeAndAfter& worn, const cloth::Fabric& fabric,
                 std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
