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

/// The state of a run of elements since the frame began.
struct RunState {
  float travel_m = 0.0f;     ///< upper bound of the path of each of its samples, relative to the body
  float next_m = 0.0f;       ///< while `travel_m` is less, no sample needs a test
  std::uint32_t active = 0;  ///< samples that may be too near
};

/// How far samples have traveled since the frame began, which decides when they are tested again.
struct SampleTravel {
  /// #clusters: longest path of a particle since the last substep, relative to the body.
  std::vector<float> step_m;
  std::vector<RunState> run;   ///< #runs
  std::vector<float> until_m;  ///< #samples: while its run's travel is less, a sample needs no test
  /// For each run, from the index of its first sample on: its samples that may be too near.
  std::vector<std::uint32_t> active;
};

/// The contact of faces with the body.
struct FaceContact {
  Elements elements;
  FaceSamples samples;
  SampleRules rules;
  std::vector<collision::Contact> nearest;  ///< #P: contacts of the particles when the frame began
  /// #P: positions of this substep, which pushes change; their weights are inverse masses.
  std::vector<Point> now;
  std::vector<Point> unpushed;  ///< #P: positions before the pushes of the last substep
  SampleTravel travel;
  std::vector<std::uint64_t> group_pushed;  ///< #groups: samples that the last sweep pushed
  std::uint64_t contacts = 0;               ///< samples that were pushed in this frame
  MotionNearParticles motion;
  bool on = false;  ///< whether there are samples in this frame
};

/// Makes the face contact of a garment at rest. It is empty without SolverOptions::face_contact, and for the
/// paper's response.
FaceContact make_face_contact(const geometry::TriMesh& mesh, const Topology& topology,
                              const SolverOptions& options, double median_edge_m, const Particles& particles);

/// Queries the particles for a body that stands still, and stores their contacts in `nearest`.
void query_particles(const engine::Context& context, const collision::Collider& body, FaceContact& faces,
                     Particles& particles);

/// Begins a frame with a body: chooses and queries its samples. Precondition: `faces.nearest` has the
/// particles' contacts.
void begin_face_frame(const engine::Context& context, const ContactFrame& frame,
                      const Environment& environment, const MotionNearParticles& motion,
                      const Particles& particles, FaceContact& faces);

/// The parameters of a substep for the contact of faces.
struct FaceSubstep {
  float length_s = 0.0f;
  float share = 0.0f;      ///< share of the frame that the substep takes
  float remaining = 0.0f;  ///< share of the frame that is left after it
};

/// Begins a substep: copies the points of the particles [begin, end), which are whole clusters, to `now`, and
/// measures how far the clusters moved.
void begin_face_substep(const FaceSubstep& substep, std::size_t begin, std::size_t end,
                        const Particles& particles, FaceContact& faces);

/// Pushes the points in `now` until no sample is too near, or a few sweeps have been made. old_* are the
/// particles' positions at the start of the substep. Samples that have not traveled far enough to come too
/// near are not tested, so that the cost grows with the samples that are near and move.
void push_faces_out(const engine::Context& context, const collision::Collider& body,
                    const FaceSubstep& substep, const Particles& particles, FaceContact& faces);

/// Ends a substep: copies the points in `now` to the positions (x, y, z) of the particles [begin, end).
void end_face_substep(std::size_t begin, std::size_t end, const FaceContact& faces, Particles& particles);

/// The report of the face contacts since the frame began.
FaceReport report_faces(const FaceContact& faces);

}  // namespace bodice::cloth
