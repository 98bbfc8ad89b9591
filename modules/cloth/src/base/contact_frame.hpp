// The body and the distances that its contact with cloth needs in a frame.
#pragma once

#include <bodice/collision/collider.hpp>

namespace bodice::inline v0_1::cloth {

/// The body in a frame, and how near it cloth may come.
struct ContactFrame {
  const collision::Collider* body = nullptr;  ///< in its pose at the end of the frame; null: there is none
  bool moving = false;                        ///< whether any ellipsoid of the body has a velocity
  double length_s = 0.0;                      ///< of the frame
  double thickness_m = 0.0;                   ///< distance that the cloth keeps from the body
  /// The longest expected travel of a particle in the frame, which bounds the queried distances. A particle
  /// that travels farther is handled correctly, but costs more.
  double travel_m = 0.0;

  /// The body if it moves, else null.
  const collision::Collider* moving_body() const { return moving ? body : nullptr; }
  /// The body if it stands still, else null.
  const collision::Collider* still_body() const { return moving ? nullptr : body; }
};

}  // namespace bodice::cloth
