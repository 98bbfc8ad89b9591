// The results that are prepared behind the frames of a session, and come into use at a frame boundary.
#pragma once

#include <cstdint>
#include <memory>

#include <bodice/tryon/reshape.hpp>
#include <bodice/tryon/session.hpp>
#include <bodice/tryon/wardrobe.hpp>

#include "motion/clip_playback.hpp"
#include "motion/moving_body.hpp"

namespace bodice::inline v0_1::tryon {

/// A clip that the session's bodies play.
struct WantedClip {
  std::uint64_t number = 0;  ///< counts calls of play(); 0: none
  MotionChoice choice;
  PlayOptions options;
};

/// A clip for one body, with its playback.
struct SessionMotion {
  std::uint64_t number = 0;  ///< number of the wanted clip
  MotionChoice choice;
  std::shared_ptr<const SegmentedSkin> skin;
  std::shared_ptr<ClipPlayback> playback;  ///< changed by the frames' thread alone
  double ramp_s = 0.0;
  rig::Playback mode = rig::Playback::kLoop;
};

/// The garments of a session.
struct Worn {
  std::shared_ptr<const Wardrobe> all;  ///< null: nothing
  double thickness_m = 0.0;
};

/// The vertices of garments that one body holds, in its bind pose.
struct HeldVertices {
  std::shared_ptr<const Wardrobe> of;
  std::vector<geometry::Vec3> bind;  ///< #held, world meters
  rig::SkinWeights weights;          ///< empty where the body stands still
};

/// A body that is ready for frames, as it is published.
struct SessionBody {
  LiveBody live;
  std::shared_ptr<const SegmentedSkin> origin;  ///< the skin that was loaded, of which live.skin is a shape
  std::shared_ptr<const proxy::BodyProxy> origin_proxy;
  std::shared_ptr<MovingBody> body;             ///< changed by the frames' thread alone
  std::shared_ptr<const SessionMotion> motion;  ///< null: no clip was wanted when the body was submitted
  HeldVertices held;  ///< held vertices of the garments that were worn when the body was made
};

/// Puts a body into its bind pose, and finds the positions of the held vertices there. Cost: a pose, and a
/// closest point a held vertex.
HeldVertices hold(const engine::Context& context, const Worn& worn, const SegmentedSkin& skin,
                  MovingBody& body);

/// Makes a body ready for frames. Precondition: its proxy is bound if `moves` is true.
engine::Result<std::shared_ptr<const SessionBody>> make_session_body(
    const engine::Context& context, LiveBody live, bool moves, std::shared_ptr<const SessionMotion> motion,
    const Worn& worn);

/// Finds the clip for a skin that has a rig.
engine::Result<std::shared_ptr<const SessionMotion>> find_session_motion(
    const engine::Context& context, const std::shared_ptr<const SegmentedSkin>& skin,
    const WantedClip& wanted);

/// The body in another shape; it plays the same clip where `motion` is not null.
engine::Result<std::shared_ptr<const SessionBody>> make_reshaped(const engine::Context& context,
                                                                 const SessionBody& body,
                                                                 const SessionMotion* motion,
                                                                 const Worn& worn,
                                                                 std::span<const geometry::Vec3> positions);

}  // namespace bodice::tryon
