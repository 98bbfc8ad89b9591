// A try-on in motion: frames of cloth on the calling thread, and bodies prepared behind them on the same
// workers.
//
//     Session session(context, {});
//     session.submit(BodyFile{"body.obj"});  // prepared behind the frames; an earlier body is canceled
//     session.dress({{.name = "dress", .mesh = mesh}});
//     while (running) {
//       const FrameOutcome outcome = session.frame(1.0 / 60.0);
//       session.positions(vertices);
//     }
//
// With SessionOptions::moves the bodies play clips: session.play({.motion = "walk"}). The clip is retargeted
// to each submitted body. In a pose far from every pose that has tables, the proxy's tables are solved anew
// behind the frames.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <bodice/cloth/solver.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/frame_pipeline.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/preparation.hpp>
#include <bodice/tryon/rigged_body.hpp>

namespace bodice::inline v0_1::tryon {

/// How bodies are prepared, frames run and garments simulated.
struct SessionOptions {
  engine::PipelineOptions pipeline;
  SegmentOptions segment;
  fitting::FitOptions fit;  ///< on_improved and on_part are replaced
  /// If given, a submitted body is fitted only where a garment worn at that time is within this distance.
  std::optional<double> region_margin_m;
  /// Bodies get a rig, and proxies that are bound to it, so that they can play clips.
  bool moves = false;
  /// Whether tables are solved anew behind the frames when the joints are far from every pose that has
  /// tables. With one worker in latency mode nothing runs behind the frames, and there are no refits.
  bool refits = true;
  std::optional<cloth::Fabric> fabric;  ///< absent: cotton
  /// Options of the solver. The defaults have eight substeps a frame, those of drape() sixteen.
  cloth::SolverOptions solver = {.pins_yield = true};
};

/// A body that frames use. Each refinement of its proxy is a new LiveBody with the same skin.
struct LiveBody {
  std::shared_ptr<const SegmentedSkin> skin;
  proxy::BodyProxy proxy;
  int refinement = 0;  ///< 0: the first, coarse proxy of this body
};

/// How a clip is played.
struct PlayOptions {
  bool loop = true;  ///< false: its last pose holds
  /// Seconds from the bind pose to the clip's first one, during which garments follow; absent:
  /// suggested_ramp_s().
  std::optional<double> ramp_s;
};

/// The outcome of a frame.
struct FrameOutcome {
  engine::FrameTiming timing;
  cloth::FrameReport cloth;
  bool has_body = false;
  std::uint64_t proxy_hash = 0;  ///< hash of the proxy in use
  bool plays = false;            ///< whether a clip moves the body
  double clip_s = 0.0;           ///< shown time of the clip, seconds; it goes on rising where the clip loops
  double ramp_left_s = 0.0;      ///< seconds that are left of a ramp to the clip's pose
  bool took_refit = false;       ///< whether tables of a further pose came into use
};

/// One body, its garments and its frames. All calls come from one thread; background work runs on the
/// context's executor.
class Session {
 public:
  /// A session without body and garments. The context's executor outlives it.
  Session(const engine::Context& context, SessionOptions options);
  /// Cancels the work in progress and waits for it.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Prepares a body behind the frames: first an ellipsoid a part, then solid parts one by one, then the
  /// proxies of FitOptions. Each takes effect at a frame boundary. Work on an earlier body is canceled. If
  /// the executor has one worker, nothing runs behind: the next frame() does the work first and is late.
  engine::Ticket submit(BodySource source);

  /// Replaces the garments; not in a frame. They keep their positions until there is a body. Fails as drape()
  /// does.
  engine::Result<void> dress(const std::vector<WornGarment>& garments);

  /// Plays a clip from its start: a made motion or a clip of a file, retargeted to the body's skeleton behind
  /// the frames. A ramp brings the body and its garments to the clip's first pose, from the bind pose, or
  /// from the current pose if another clip is played. Bodies that are submitted later play the clip from the
  /// time that it has reached. The ticket reports the error of a clip that is not found. If there is no body
  /// yet, the ticket is done at once, and the body's own ticket reports that error. Without
  /// SessionOptions::moves it fails with kInvalidArgument.
  engine::Ticket play(MotionChoice choice, const PlayOptions& options = {});
  /// Frames go on, but the body stays in its pose until resume().
  void pause() noexcept;
  /// Goes on with the clip after pause().
  void resume() noexcept;
  /// Moves to a second of the clip, over `ramp_s` so that garments can follow; zero jumps. Does nothing while
  /// no clip is played.
  void seek(double time_s, double ramp_s = 0.5);

  /// Gives the body in use another shape: `positions` are those of its skin's vertices (#V of LiveBody::skin,
  /// meters, bind pose), as a slider moves them. Behind the frames its ellipsoids are carried there, its
  /// tables are solved anew (reshape_body()), and it takes effect at a boundary. From then on, surface, skin
  /// and held vertices move to the new shape within a sixth of a second, or longer where they would be faster
  /// than 0.1 m/s; garments stay on. One shape is computed at a time; of the waiting ones only the newest is
  /// kept. Fails with kInvalidArgument for another number of vertices, positions that are not finite, or
  /// where there is no body.
  engine::Result<void> reshape(std::vector<geometry::Vec3> positions);

  /// Runs a frame boundary, then dt_s of the clip and of cloth. Allocates nothing once warm, except in the
  /// first frame of a new proxy, clip or refit.
  FrameOutcome frame(double dt_s);

  /// The body in use, or null before the first one; valid until the next frame().
  const LiveBody* body() const noexcept;
  /// The body's skin in the pose of the last frame, as many positions as LiveBody::skin has. Without a body
  /// nothing is written.
  void skin_positions(std::span<geometry::Vec3> out) const;
  /// The collider in the pose of the last frame; null before the first body. Beyond the reach of the
  /// garments, if there are any, tables of a body that moves stay as at rest.
  const collision::Collider* collider() const noexcept;
  /// The proxy in the pose of the last frame, as collider() has it; null where the body does not move.
  const proxy::PosedProxy* posed() const noexcept;
  /// The number of vertices of all garments, in the order given to dress().
  std::size_t vertices() const noexcept;
  /// Writes the world positions of these vertices.
  void positions(std::span<geometry::Vec3> out) const;
  std::uint64_t hash() const noexcept;  ///< of the cloth's state

  /// The pipeline that runs the frames, for work of the host beside them.
  engine::FramePipeline& pipeline() noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::tryon
