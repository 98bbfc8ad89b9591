// Finds the side of the body on which a sample inside it belongs. Where a triangle cuts a limb, the closest
// surface may be on the other side of the limb, and a push there would pull the cloth through.
#pragma once

#include "faces/face_contact.hpp"

namespace bodice::inline v0_1::cloth {

/// Whether a sample inside the body would be pushed toward the side that its particles lie on. If not, the
/// closest surface and the surface below a particle oppose each other, and the latter lies behind the former.
/// Between two toes the surfaces oppose each other as well, but each lies ahead of the other.
bool is_on_its_side(const FaceSample& sample, const FaceContact& faces);

/// Gives a sample that is not on its side the surface that it meets along the mean of the normals at its
/// particles, seen from outside. Returns false and changes nothing where there is none: where the particles
/// lie on opposite sides of a limb, no side is right, and only the particles are moved out, by the paths that
/// are stored for them. Takes up to nine queries.
/// Based on: John C. Hart. Sphere Tracing: A Geometric Method for the Antialiased Ray Tracing of Implicit
/// Surfaces. 1996. - section 2
bool take_to_own_side(const collision::Collider& body, const FaceContact& faces, FaceSample& sample);

}  // namespace bodice::cloth
