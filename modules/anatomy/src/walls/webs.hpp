// Skin that hides the fold of an armpit or of the crotch.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Where a limb has grown together with the trunk, or both thighs with each other, beyond the fold that they
/// meet in.
struct Web {
  body::LandmarkId id = body::LandmarkId::kPerineum;  ///< the landmark that it leads astray
  geometry::Vec3 edge = geometry::Vec3::Zero();       ///< where its skin lies, and the landmark was found
  geometry::Vec3 fold = geometry::Vec3::Zero();       ///< where the fold that it hides would be
};

/// Limbs are apart on the outer side of the plane through `at`.
struct Fold {
  body::LandmarkId id = body::LandmarkId::kPerineum;  ///< the landmark that lies in it
  geometry::Vec3 at = geometry::Vec3::Zero();
  geometry::Vec3 inward = geometry::Vec3::UnitY();  ///< unit
};

/// The fold where `found` has its landmark.
Fold fold_at(const Anatomy& found, body::LandmarkId id);

/// The folds at the armpits and the crotch of a skin on which limbs have grown together. `found` was found on
/// a copy on which they are apart.
std::vector<Fold> find_folds(const engine::Context& context, const geometry::TriMesh& skin,
                             const Anatomy& found);

/// How far above a landmark the room inside the body shows its fold, as a fraction of the stature; on whole
/// bodies mostly some .01 below it. Empty where no level is as deep between the limbs as in them.
std::optional<double> web_height(const engine::Context& context, const geometry::TriMesh& skin,
                                 const Anatomy& found, body::LandmarkId id);

/// The webs at the armpits and the crotch where `found` has them. Inside the body, a plane between two limbs
/// has less room than the limbs beside it; above their fold it has as much. `made_up`: #V or empty, the
/// vertices that close holes, where less of a web is enough. Cost: tens of milliseconds.
std::vector<Web> find_webs(const engine::Context& context, const geometry::TriMesh& skin,
                           const Anatomy& found, std::span<const std::uint8_t> made_up = {});

}  // namespace bodice::anatomy
