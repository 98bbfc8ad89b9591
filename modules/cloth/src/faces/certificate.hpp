// A proof that no point of any triangle is deeper in the body than a tolerance, and pushes where there is
// none.
//
// A distance changes by at most `slope` times the length of a path between two points. So a point at distance
// d proves that a disc of radius (d + tolerance) / slope around it is not deeper than the tolerance. A
// triangle that the disc of its center does not cover is cut in four, and so on. Points deeper than half the
// tolerance are pushed out, each by its barycentric weights, and triangles that moved are proved again. The
// cost grows with the cloth that is near the body.
#pragma once

#include <cstdint>
#include <vector>

#include "faces/face_contact.hpp"

namespace bodice::inline v0_1::cloth {

/// The memory and the results of the proofs of a frame.
struct FaceCertificate {
  std::vector<std::uint8_t> due;          ///< #runs: whether its triangles are to be proved
  std::vector<std::uint8_t> moved;        ///< #clusters: whether a particle was pushed since its proof
  std::vector<std::uint32_t> deep_count;  ///< #runs: points to push
  std::vector<FaceSample> deep;           ///< #runs x kDeepARun
  std::vector<std::uint32_t> open;        ///< #runs: triangles without a proof
};

/// The most points that are pushed in a run of elements and a round.
inline constexpr std::size_t kDeepARun = 64;

/// Memory for the proofs of this garment.
FaceCertificate make_certificate(const Elements& elements, std::size_t particles);

/// Proves all triangles against the body in its pose at the end of a frame. Where a point is too deep, it
/// moves particles (x, y, z) and leaves their velocities. Returns the number of triangles without a proof.
/// Allocates nothing; the result is the same for any number of workers.
FaceProof prove_faces(const engine::Context& context, const collision::Collider& body, float tolerance_m,
                      const FaceContact& faces, Particles& particles, FaceCertificate& certificate);

}  // namespace bodice::cloth
