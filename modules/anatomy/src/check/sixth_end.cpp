#include "check/sixth_end.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::anatomy {
namespace {

/// The largest distance along the skin to the nearest extremity that a body may have, a fraction of its size.
/// 1,200 bodies of all builds and poses have .70 at most, at the middle of a heavy trunk. Of 48 pairs of
/// people in one skin, 40 have more, up to 1.1; the others are refused for their parts.
constexpr float kFarthestSkin = 0.73F;

float farthest_from_extremities(const Skin& skin, const BodyExtremities& tips) {
  float farthest = 0.0F;
  for (std::size_t v = 0; v < skin.mesh.positions.size(); ++v) {
    if (skin.component[v] != 0) continue;
    const float nearest = std::min({(*tips.from_head)[v], (*tips.from_hand[0])[v], (*tips.from_hand[1])[v],
                                    (*tips.from_foot[0])[v], (*tips.from_foot[1])[v]});
    if (std::isfinite(nearest)) farthest = std::max(farthest, nearest);
  }
  return farthest;
}

}  // namespace

std::optional<std::string> sixth_end_clause(const Skin& skin, const BodyExtremities& tips, float size_m) {
  const float away = farthest_from_extremities(skin, tips) / size_m;
  if (!(away > kFarthestSkin)) return std::nullopt;
  return engine::message("its skin has a sixth end, ", std::lround(100.0F * away),
                         " % of its height away from head, hands and feet, such as that of another person or "
                         "of furniture");
}

}  // namespace bodice::anatomy
