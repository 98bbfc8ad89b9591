// The state of a session, and its steps at a frame boundary.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <bodice/tryon/garment_reach.hpp>

#include "motion/refits.hpp"
#include "session/session_body.hpp"

namespace bodice::inline v0_1::tryon {

/// A requested shape of the body, numbered by requests. A null body means that the request failed.
struct SessionShape {
  std::uint64_t number = 0;
  std::shared_ptr<const SessionBody> body;
};

struct Session::Impl {
  Impl(const engine::Context& context, SessionOptions o)
      : options(std::move(o)),
        nothing_runs_behind(context.executor->concurrency() == 1 &&
                            options.pipeline.mode == engine::PipelineMode::kLatency),
        pipeline(context, options.pipeline),
        bodies(pipeline),
        motions(pipeline),
        shapes(pipeline),
        refits(pipeline) {}

  SessionOptions options;
  bool nothing_runs_behind;
  engine::FramePipeline pipeline;
  engine::Stream<SessionBody> bodies;  // streams after the pipeline, because they must be destroyed first
  engine::Stream<SessionMotion> motions;
  engine::Stream<SessionShape> shapes;
  Refits refits;
  std::optional<cloth::Solver> solver;
  std::shared_ptr<const Wardrobe> wardrobe;  // null: no garments

  const SessionBody* seen_body = nullptr;  // the results of the streams at the last frame boundary
  const SessionMotion* seen_motion = nullptr;
  const SessionShape* seen_shape = nullptr;
  std::shared_ptr<const SessionBody> body;  // in use
  std::shared_ptr<const SessionMotion> motion;
  WantedClip wanted;
  bool paused = false, jumped = false;
  bool new_shape = false;  // since the last pose, the body has become another shape of itself
  std::vector<geometry::Vec3> wanted_shape;  // empty: none waits
  std::uint64_t shapes_begun = 0, shapes_done = 0;
  engine::Ticket reshape;  ///< the last one; after a failure nothing of it is published

  HeldVertices held_now;  // held vertices that were found in a frame, because the garments changed after the
                          // body was made
  const HeldVertices* held = nullptr;  // null: to be found in the next frame
  // Positions in the earlier shape, in the present shape, and in the pose.
  std::vector<geometry::Vec3> held_before, held_at_rest, posed;
  std::vector<geometry::Vec3> cloth;  // #vertices of all garments, after the last frame
  std::optional<GarmentReach> reach;  // of the garments

  Worn worn() const { return {wardrobe, options.solver.thickness_m}; }
  void take_results(FrameOutcome& outcome);
  void take_body(std::shared_ptr<const SessionBody> next);
  void take_motion(std::shared_ptr<const SessionMotion> next);
  void hold_garments(const engine::Context& context);
  void pose(const engine::Context& context, double dt_s);
  void move_held();
  void begin_shape();
  engine::Ticket find_wanted_clip();
};

}  // namespace bodice::tryon
