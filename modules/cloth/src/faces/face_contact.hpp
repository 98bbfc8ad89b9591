// Contact of whole edges and triangles with the body. Samples between the particles (face_samples.hpp) that
// come too near push the particles of their element, each by its barycentric weight and inverse mass.
// Based on: Miles Macklin, Matthias Mueller, Nuttapong Chentanez. XPBD: Position-Based Simulation of
// Compliant Constrained Dynamics. 2016. - section 3 (a contact as a constraint on weighted points)
// Differs: no compliance. Distances are queried anew only where a sample has moved, and are linear between
// queries.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/cloth/solver.hpp>

#include "faces/face_samples.hpp"

namespace bodice::cloth {

/// The contact of faces with the body.
struct FaceContact {
  Elements elements;
  FaceSamples samples;
  SampleRules rules;
  std::vector<collision::Contact> nearest;  ///< #P: contacts of the particles when the frame began
  std::vector<Point> now;                   ///< #P: positions that are pushed, with weights
  std::vector<std::uint32_t> active;  ///< from the start of each chunk: its samples that may be too near
  std::vector<std::uint32_t> active_count;    ///< #chunks
  std::vector<std::uint64_t> group_contacts;  ///< #groups: samples that were pushed in this frame
  bool on = false;                            ///< whether there are samples in this frame
};

/// The contact of this garment at rest with a body, at the thickness of the options.
FaceContact make_face_contact(const geometry::TriMesh& mesh, const Topology& topology,
                              const SolverOptions& options, double median_edge_m, const Particles& particles);

/// Queries the particles as they are, for a body that stands still: fills `nearest`.
void query_particles(const engine::Context& context, const collision::Collider& body, FaceContact& faces,
                     Particles& particles);

/// Begins a frame with a body. `nearest` of `faces` has the particles' contacts.
void begin_face_frame(const engine::Context& context, const collision::Collider& body, double frame_s,
                      const Environment& environment, const MotionNearParticles& motion,
                      const Particles& particles, FaceContact& faces);

/// What a substep does with the faces.
struct FaceSubstep {
  float length_s = 0.0f;
  float remaining = 0.0f;  ///< share of the frame that is left after it
};

/// Moves the particles (x, y, z) until no sample is too near, as far as few sweeps lead. The points have the
/// particles' weights; old_* are their positions at the start of the substep.
void push_faces_out(const engine::Context& context, const collision::Collider& body,
                    const FaceSubstep& substep, Particles& particles, FaceContact& faces);

/// What happened since the frame began.
FaceReport report_faces(const FaceContact& faces);

}  // namespace bodice::cloth
