// Refits behind the frames of a session. Where the joints are far from every base pose, tables are solved
// anew for a pose, and come into use at a frame boundary.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <bodice/engine/frame_pipeline.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/tryon/prepare.hpp>

#include "motion/clip_playback.hpp"
#include "motion/moving_body.hpp"

namespace bodice::inline v0_1::tryon {

/// Decides when a refit is worth its time, and runs at most one at a time.
class Refits {
 public:
  explicit Refits(engine::FramePipeline& pipeline) : stream_(pipeline) {}

  /// Gives the body a base pose that has become ready since the last call, if it belongs to the body's proxy;
  /// returns whether it did. The share of the base pose rises over some frames, so that the surface does not
  /// jump.
  bool take(const proxy::BodyProxy& proxy, MovingBody& body);

  /// Begins a refit if the joints will soon be far from every base pose of the body. It solves the tables for
  /// the pose that a moving body will have when the refit is ready.
  void begin_if_needed(const std::shared_ptr<const SegmentedSkin>& skin, const proxy::BodyProxy& proxy,
                       MovingBody& body, ClipPlayback& playback, bool paused);

 private:
  struct Refit {
    std::uint64_t proxy_hash = 0;
    std::shared_ptr<const proxy::BasePose> base;  ///< null: the pose was refused
  };

  engine::Stream<Refit> stream_;
  const Refit* taken_ = nullptr;
  bool runs_ = false;
  std::vector<rig::Affine> ahead_;  // #J
};

}  // namespace bodice::tryon
