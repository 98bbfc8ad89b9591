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

/// How bodies are prepared, frames run and garments simulated.
struct SessionOptions {
  engine::PipelineOptions pipeline;
  SegmentOptions segment;
  fitting::FitOptions fit;  ///< on_improved and on_part are replaced
  /// If given, a submitted body is fitted only where a garment worn at that time is within this distance.
  std::optional<double> region_margin_m;
  std::optional<cloth::Fabric> fabric;  ///< absent: cotton
  cloth::SolverOptions solver;  ///< the defaults: eight substeps for a runtime, not the sixteen of drape()
};

/// A body as the frames use it. Each refinement of its proxy is a new one, with the same skin.
struct LiveBody {
  std::shared_ptr<const SegmentedSkin> skin;
  proxy::BodyProxy proxy;
  collision::Collider collider;
  int refinement = 0;  ///< 0: the first, coarse proxy of this body
};

/// What a frame did.
struct FrameOutcome {
  engine::FrameTiming timing;
  cloth::FrameReport cloth;
  bool has_body = false;
  std::uint64_t proxy_hash = 0;  ///< hash of the proxy in use
};

/// One body, its garments and its frames. All calls come from one thread; background work runs on the
/// context's executor.
class Session {
 public:
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

  /// Runs a frame boundary, then dt_s of cloth. Allocates nothing once warm, except in the first frame of a
  /// new proxy.
  FrameOutcome frame(double dt_s);

  /// The body in use, or null before the first one; valid until the next frame().
  const LiveBody* body() const noexcept;
  /// The number of vertices of all garments, in the order given to dress().
  std::size_t vertices() const noexcept;
  void positions(std::span<geometry::Vec3> out) const;
  std::uint64_t hash() const noexcept;  ///< of the cloth's state

  engine::FramePipeline& pipeline() noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::tryon
