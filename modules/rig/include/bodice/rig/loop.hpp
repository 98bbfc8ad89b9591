// Clips that are played again and again.
#pragma once

#include <bodice/rig/clip.hpp>

namespace bodice::inline v0_1::rig {

/// A clip that leads from its end back to its start: longer by `seam_s` seconds, with its first pose at its
/// end. Over the seam each joint leaves the end and reaches the start with the clip's own velocities there;
/// scales go from one to the other, and step keys hold. Cubic keys become linear ones, 60 a second. Without a
/// seam (zero or less), or without a length, the clip stays as it is. Allocates. O(#keys + #tracks seam_s).
/// Precondition: valid.
Clip close_loop(const Clip& clip, double seam_s);

/// A clip of `duration_s` seconds that plays another one over and over; one that is not shorter, or has no
/// length, stays as it is. Cubic keys become linear ones, 60 a second. Allocates. O(#keys duration_s /
/// clip.duration_s). Precondition: valid.
Clip repeat(const Clip& clip, double duration_s);

}  // namespace bodice::rig
