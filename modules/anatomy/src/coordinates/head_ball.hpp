// The head as a ball.
#pragma once

#include "coordinates/body_coordinates.hpp"
#include "skin/ball.hpp"

namespace bodice::inline v0_1::anatomy {

/// The ball that the skin above the neck's border resembles; its radius is 0 where there is no such skin.
/// O(#F).
inline Ball head_ball(const Skin& skin, const BodyCoordinates& coordinates) {
  std::vector<char> head(skin.mesh.positions.size());
  for (std::size_t v = 0; v < head.size(); ++v) head[v] = skin.component[v] == 0 && coordinates.on_head(v);
  return ball_of(skin, [&](geometry::Index v) { return head[v] != 0; });
}

}  // namespace bodice::anatomy
