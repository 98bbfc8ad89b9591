// A try-on in motion: frames of cloth in front, bodies prepared behind them on the same workers.
//
//     Session session(context, {});
//     session.submit(BodyFile{"body.obj"});  // behind the frames; work on an earlier body stops
//     session.dress({{.name = "dress", .mesh = mesh}});
//     while (running) {
//       const FrameOutcome outcome = session.frame(1.0 / 60.0);
//       session.positions(vertices);
//     }
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <bodice/cloth/solver.hpp>
#include <bodice/engine/frame_pipeline.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/preparation.hpp>

namespace bodice::tryon {

struct SessionOptions {
  engine::PipelineOptions pipeline;
  SegmentOptions segment;
  fitting::FitOptions fit;  ///< its on_improved and on_part are the session's
  /// Given: a submitted body is fitted only where a garment worn at that moment is within this distance.
  std::optional<double> region_margin_m;
  std::optional<cloth::Fabric> fabric;  ///< absent: cotton
  cloth::SolverOptions solver;          ///< as they stand: a runtime's eight substeps, not drape()'s sixteen
};

/// A body as the frames see it. Each refinement of its proxy is a new one, with the same skin.
struct LiveBody {
  std::shared_ptr<const SegmentedSkin> skin;
  proxy::BodyProxy proxy;
  collision::Collider collider;
  int refinement = 0;  ///< 0: the first, coarse proxy of this body
};

struct FrameOutcome {
  engine::FrameTiming timing;
  cloth::FrameReport cloth;
  bool has_body = false;
  std::uint64_t proxy_hash = 0;  ///< of the proxy in force
};

/// One body, its garments, its frames. One thread calls it; background work runs on the context's executor.
class Session {
 public:
  Session(const engine::Context& context, SessionOptions options);
  /// Cancels the work under way and waits for it.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Prepares a body behind the frames: an ellipsoid a part at first, then solid parts as each is ready, then
  /// what FitOptions asks for. Each takes effect at a frame boundary. Work on an earlier body stops. Where
  /// the executor has one worker, nothing runs behind: the next frame() does the work first and is late.
  engine::Ticket submit(BodySource source);

  /// Puts garments on, in place of those worn; not in a frame. They wait where they are for the first body.
  /// Fails as drape() does.
  engine::Result<void> dress(const std::vector<WornGarment>& garments);

  /// A frame boundary, then dt_s of cloth. Allocates nothing once warm, but for the first frame of a new
  /// proxy.
  FrameOutcome frame(double dt_s);

  /// The body in force, or null before the first; valid until the next frame().
  const LiveBody* body() const noexcept;
  /// Vertices of all garments in the order given to dress().
  std::size_t vertices() const noexcept;
  void positions(std::span<geometry::Vec3> out) const;
  std::uint64_t hash() const noexcept;  ///< of the cloth's state

  engine::FramePipeline& pipeline() noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::tryon
