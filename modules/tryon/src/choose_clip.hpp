#pragma once

#include <bodice/engine/result.hpp>
#include <bodice/rig/clip.hpp>
#include <bodice/tryon/rigged_body.hpp>

namespace bodice::tryon {

/// The clip that is named, or the first for an empty name. Fails with kInvalidArgument, and lists the names
/// there are, where there is none.
engine::Result<rig::Clip> choose_clip(const MotionChoice& choice, const std::vector<rig::Clip>& clips);

}  // namespace bodice::tryon
