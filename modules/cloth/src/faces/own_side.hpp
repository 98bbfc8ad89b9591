// Finds the side of the body to which a sample inside it must be pushed. Where a triangle cuts a limb, the
// closest surface may be on the far side of the limb, and a push to it would pull the cloth through.
#pragma once

#include "faces/face_contact.hpp"

namespace bodice::inline v0_1::cloth {

/// Whether a push to the closest surface brings a sample to the side on which its particles lie. It does not
/// where the normals at the closest surface and below a particle oppose each other, and the particle's
/// surface lies behind the closest one. Between two toes the normals oppose each other as well, but each
/// surface lies in front of the other.
bool is_on_its_side(const FaceSample& sample, const FaceContact& faces);

/// Gives a sample that is not on its side another surface: the first one on a ray that comes from outside,
/// along the mean of the normals at its particles. Returns false and changes nothing where there is none. If
/// the particles lie on opposite sides of a limb, no side is right, and only contact of particles moves the
/// cloth out. Cost: up to nine queries.
/// Based on: John C. Hart. Sphere Tracing: A Geometric Method for the Antialiased Ray Tracing of Implicit
/// Surfaces. 1996. - section 2
bool move_to_own_side(const collision::Collider& body, const FaceContact& faces, FaceSample& sample);

}  // namespace bodice::cloth
