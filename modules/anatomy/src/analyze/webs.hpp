// Skin that hides the fold of an armpit or of the crotch.
#pragma once

#include <vector>

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Where a limb has grown together with the trunk, or both thighs with each other, beyond the fold that they
/// meet in. It lies in the plane through `edge`, `fold` and `forward`.
struct Web {
  body::LandmarkId id = body::LandmarkId::kPerineum;  ///< the landmark that it leads astray
  geometry::Vec3 edge = geometry::Vec3::Zero();       ///< where its skin lies, and the landmark was found
  geometry::Vec3 fold = geometry::Vec3::Zero();       ///< where the fold that it hides would be
  geometry::Vec3 forward = geometry::Vec3::UnitZ();   ///< unit, from the back of the web to its front
};

/// The webs at the armpits and the crotch where `found` has them. Inside the body, a plane between two limbs
/// has less room than the limbs beside it; above their fold it has as much. Cost: tens of milliseconds.
std::vector<Web> find_webs(const engine::Context& context, const geometry::TriMesh& skin,
                           const Anatomy& found);

}  // namespace bodice::anatomy
