// Parts of a thing that is no person: a chair, a dog, a hand. It has no anatomy; its surface is clustered.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Cuts the surface into at most body::kThingPartCount parts of similar width, body::thing_part() by falling
/// area. Limbs and loose pieces become parts of their own as far as the number allows. All landmarks have
/// confidence 0, `up` is y, and `stature_m` is that of a person with as much skin: the scale of a fit. Fails
/// with kUnusableGeometry where the surface encloses nothing, and with kCanceled. Precondition: a repaired
/// mesh. The same bits for any number of workers. O(#V) for each part. Based on: Stuart P. Lloyd. Least
/// squares quantization in PCM. 1982. Differs: distances are geodesic, and centers are vertices.
engine::Result<Anatomy> analyze_thing(const engine::Context& context, const geometry::TriMesh& skin);

}  // namespace bodice::anatomy
