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
// With SessionOptions::moves the bodies play clips: session.play({.motion = "walk"}). A clip is carried over
// to each body that comes, and where the joints leave what the proxy's tables carry, these are solved anew
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
  /// Tables of a body that moves are solved anew behind the frames where its joints are far from those that
  /// it has tables for. With one worker in latency mode nothing runs behind, and this does nothing.
  bool refits = true;
  std::optional<cloth::Fabric> fabric;  ///< absent: cotton
  cloth::SolverOptions solver;  ///< the defaults: eight substeps for a runtime, not the sixteen of drape()
};

/// A body as the frames use it. Each refinement of its proxy is a new one, with the same skin.
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

/// What a frame did.
struct FrameOutcome {
  engine::FrameTiming timing;
  cloth::FrameReport cloth;
  bool has_body = false;
  std::uint64_t proxy_hash = 0;  ///< hash of the proxy in use
  bool plays = false;            ///< whether a clip moves the body
  double clip_s = 0.0;           ///< time of the clip that is shown; where it loops, it goes on
  double ramp_left_s = 0.0;      ///< above 0: a ramp still leads to the clip's pose
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

  /// Plays a clip from its begin: a made motion or one of a file, carried over to the body's skeleton behind
  /// the frames. Garments are brought to its first pose by a ramp from the bind pose, or from the pose in
  /// force if another clip is played. Bodies submitted later play it as well, from where it is then. The
  /// ticket has the error of a clip that is not found, or is done where there is no body yet (its own ticket
  /// then has it). Without SessionOptions::moves it fails with kInvalidArgument.
  engine::Ticket play(MotionChoice choice, const PlayOptions& options = {});
  /// Frames go on, but the body stays in its pose until resume().
  void pause() noexcept;
  /// Goes on with the clip after pause().
  void resume() noexcept;
  /// Moves to a second of the clip, over `ramp_s` so that garments can follow; zero jumps. Does nothing while
  /// no clip is played.
  void seek(double time_s, double ramp_s = 0.5);

  /// Gives the body in use another shape: `positions` are those of its skin's vertices (#V of
  /// LiveBody::skin, meters, bind pose), as a slider moves them. Behind the frames its ellipsoids are carried
  /// there, its tables are solved anew (reshape_body()), and it takes effect at a boundary. From then on the
  /// surface, the skin and held vertices go over to it within a sixth of a second, or longer where they would
  /// move faster than .1 m/s; garments stay on.
  /// One shape is worked on at a time; of those that wait the newest counts. Fails with kInvalidArgument for
  /// another number of vertices, positions that are not finite, or where there is no body.
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
