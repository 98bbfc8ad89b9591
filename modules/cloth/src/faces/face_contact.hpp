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

#include "base/contact_frame.hpp"
#include "faces/face_samples.hpp"

namespace bodice::inline v0_1::cloth {

/// What a run of elements did since the frame began.
struct RunState {
  float travel_m = 0.0f;     ///< bounds the path of each of its samples, relative to the body
  float next_m = 0.0f;       ///< travel up to which no sample needs to be looked at
  std::uint32_t active = 0;  ///< samples that may be too near
};

/// The contact of faces with the body.
struct FaceContact {
  Elements elements;
  FaceSamples samples;
  SampleRules rules;
  std::vector<collision::Contact> nearest;  ///< #P: contacts of the particles when the frame began
  std::vector<Point> now;                   ///< #P: positions that are pushed, with weights
  std::vector<Point> entered;               ///< #P: positions when the substep before began to push
  std::vector<float> step_m;                ///< #clusters: longest path between these, relative to the body
  std::vector<RunState> run;                ///< #runs
  std::vector<float> until_m;         ///< #samples: travel of its run up to which one need not be looked at
  std::vector<std::uint32_t> active;  ///< from a run's first sample on: its samples that may be too near
  std::vector<std::uint64_t> group_pushed;  ///< #groups: samples that the last sweep pushed
  std::uint64_t contacts = 0;               ///< samples that were pushed in this frame
  MotionNearParticles motion;
  bool on = false;  ///< whether there are samples in this frame
};

/// The contact of this garment at rest with a body, at the thickness of the options.
FaceContact make_face_contact(const geometry::TriMesh& mesh, const Topology& topology,
                              const SolverOptions& options, double median_edge_m, const Particles& particles);

/// Queries the particles as they are, for a body that stands still: fills `nearest`.
void query_particles(const engine::Context& context, const collision::Collider& body, FaceContact& faces,
                     Particles& particles);

/// Begins a frame with a body. `nearest` of `faces` has the particles' contacts.
void begin_face_frame(const engine::Context& context, const ContactFrame& frame,
                      const Environment& environment, const MotionNearParticles& motion,
                      const Particles& particles, FaceContact& faces);

/// What a substep does with the faces.
struct FaceSubstep {
  float length_s = 0.0f;
  float share = 0.0f;      ///< of the frame
  float remaining = 0.0f;  ///< share of the frame that is left after it
};

/// Takes the points of the particles [begin, end), which are whole clusters, to be pushed in this substep.
void enter_faces(const FaceSubstep& substep, std::size_t begin, std::size_t end, const Particles& particles,
                 FaceContact& faces);

/// Moves what enter_faces() took until no sample is too near, as far as few sweeps lead. old_* are the
/// particles' positions at the start of the substep. Samples that have not traveled far enough to come too
/// near are not looked at, so that cost follows what is near and moves.
void push_faces_out(const engine::Context& context, const collision::Collider& body,
                    const FaceSubstep& substep, const Particles& particles, FaceContact& faces);

/// Writes what was pushed to the positions (x, y, z) of the particles [begin, end).
void leave_faces(std::size_t begin, std::size_t end, const FaceContact& faces, Particles& particles);

/// What happened since the frame began.
FaceReport report_faces(const FaceContact& faces);

}  // namespace bodice::cloth
