// Furniture and floors that have grown together with a body: they are flat, and bodies are not.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// The share of the area that lies in a few planes, those of the soles not counted: `up` is the body's.
/// O(#F).
double flat_share(const geometry::TriMesh& skin, const geometry::Vec3& up);
/// The flat share from which something in the skin is no body. Bodies alone have no flat share, and bodies
/// with a chair have at least .067.
inline constexpr double kMostFlat = 0.04;

/// Adds the warning "flat-parts" where something in the skin is flat.
void warn_of_flat_parts(const geometry::TriMesh& skin, Anatomy& anatomy);

}  // namespace bodice::anatomy
