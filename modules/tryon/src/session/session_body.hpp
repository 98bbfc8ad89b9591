// What a session's frames take at a boundary, prepared behind them.
#pragma once

#include <cstdint>
#include <memory>

#include <bodice/tryon/reshape.hpp>
#include <bodice/tryon/session.hpp>

#include "motion/clip_playback.hpp"
#include "motion/moving_body.hpp"

namespace bodice::tryon {

/// A clip that the session's bodies play.
struct WantedClip {
  std::uint64_t number = 0;  ///< counts calls of play(); 0: none
  MotionChoice choice;
  PlayOptions options;
};

/// The clip as one body plays it.
struct SessionMotion {
  std::uint64_t number = 0;  ///< of the wanted clip
  std::shared_ptr<const SegmentedSkin> skin;
  std::shared_ptr<ClipPlayback> playback;  ///< changed by the frames' thread alone
  double ramp_s = 0.0;
  rig::Playback mode = rig::Playback::kLoop;
};

/// A body as it is published.
struct SessionBody {
  LiveBody live;
  std::shared_ptr<const SegmentedSkin> origin;  ///< the skin that was loaded, of which live.skin is a shape
  std::shared_ptr<const proxy::BodyProxy> origin_proxy;
  std::shared_ptr<MovingBody> body;             ///< changed by the frames' thread alone
  std::shared_ptr<const SessionMotion> motion;  ///< null: none was wanted when it was submitted
};

/// A body ready for frames; its proxy is bound where it `moves`.
engine::Result<std::shared_ptr<const SessionBody>> make_session_body(
    LiveBody live, bool moves, std::shared_ptr<const SessionMotion> motion);

/// Finds the clip for a skin that has a rig.
engine::Result<std::shared_ptr<const SessionMotion>> find_session_motion(
    const engine::Context& context, const std::shared_ptr<const SegmentedSkin>& skin,
    const WantedClip& wanted);

/// The body in another shape; it plays the same clip where `motion` is not null.
engine::Result<std::shared_ptr<const SessionBody>> make_reshaped(const engine::Context& context,
                                                                 const SessionBody& body,
                                                                 const SessionMotion* motion,
                                                                 std::span<const geometry::Vec3> positions);

}  // namespace bodice::tryon
