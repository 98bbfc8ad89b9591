// A rig for every body, and the motions that it plays.
#pragma once

#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/tryon/motion.hpp>
#include <bodice/tryon/preparation.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// Gives a skin without a rig a rig: for a built-in body its own, otherwise a found rig (rigging::make_rig).
/// A skin that has a rig keeps it. Errors name the body and the remedy. Cost: that of make_rig().
engine::Result<void> give_rig(const engine::Context& context, const BodySource& source, SegmentedSkin& skin);

/// The weights of a body's input vertices (those of the file or mesh) for the skin that repair made of them.
/// Where several input vertices became one, the first counts. Precondition: a row for each input vertex.
rig::SkinWeights weights_of_skin(const rig::SkinWeights& input, const io::ImportedMesh& body);

/// The name of a clip: that of a made motion (rigging::kMotionNames), or a file with a skeleton and clips.
struct MotionChoice {
  std::string motion;
  std::string clip;  ///< name of a clip of the file; empty: its first
};

/// The clip of a file that is named, or its first for an empty name. Fails with kInvalidArgument where there
/// is none, and lists the names there are.
engine::Result<rig::Clip> choose_clip(const MotionChoice& choice, const std::vector<rig::Clip>& clips);
/// Fails with kInvalidArgument where the clip has no pose at that second, and states its duration.
engine::Result<void> check_time(const rig::Clip& clip, double time_s);

/// Finds a clip, and retargets it to the skin's skeleton where it belongs to another one; `warnings` receives
/// joints without a partner. Precondition: the skin has a rig. Fails with kNotFound for an unknown name, and
/// with kInvalidArgument for a clip that the file does not have; the remedy lists those that exist. Fails
/// also as rigging::make_clip(), rig::retarget() and io::import_motion() do. Cost: that of these.
engine::Result<BodyMotion> find_motion(const engine::Context& context, const SegmentedSkin& skin,
                                       const MotionChoice& choice, std::vector<engine::Warning>& warnings);

/// The same clip on another shape of the body. A made motion is made anew, with the arms held out as
/// rigging::keep_arms_clear_deg() gives it for the shape.
engine::Result<BodyMotion> motion_of_shape(const engine::Context& context, const SegmentedSkin& skin,
                                           const MotionChoice& choice, const BodyMotion& before);

}  // namespace bodice::tryon
