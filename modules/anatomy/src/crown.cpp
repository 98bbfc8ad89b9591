#include "crown.hpp"

#include <algorithm>
#include <cmath>

#include "ball.hpp"
#include "soft_place.hpp"

namespace bodice::anatomy {
namespace {

using geodesic::Field;
using geometry::Index;

/// Where the crown divides the way over the head from the back of the neck to its front: the same on children
/// and adults, whatever the size of the head.
constexpr float kFromNape = 0.485F;
/// What the square of a deviation from that share costs against distance from the feet, of the size. Without
/// it the forehead wins on bodies that lean back.
constexpr float kShareWeight = 2.0F;
/// How much of that score the dome of the head spans, and how far it reaches; of the size.
constexpr float kDome = 0.02F, kDomeRadius = 0.07F;

}  // namespace

Crown find_crown(const Skin& skin, const BodyCoordinates& coordinates, const Girth& neck) {
  const BodyEnds& ends = coordinates.ends();
  const float size = coordinates.size_m();
  const Field &left = *ends.from_foot[0], &right = *ends.from_foot[1];
  std::vector<char> head(skin.mesh.positions.size());
  for (std::size_t v = 0; v < head.size(); ++v) head[v] = skin.component[v] == 0 && coordinates.on_head(v);
  const Ball ball = ball_of(skin, [&](Index v) { return head[v] != 0; });
  const auto score = [&](Index v) {
    const float nape = coordinates.from_back()[v] - neck.from_back;
    const float throat = coordinates.from_front()[v] - neck.from_front;
    const float off = nape / std::max(nape + throat, 1e-6F * size) - kFromNape;
    return 0.5F * (left[v] + right[v]) / size - kShareWeight * off * off;
  };
  Crown crown{skin.mesh.positions[ends.head], ends.head};
  if (neck.vertex == geometry::kNoIndex) return crown;
  float most = -1.0F;
  for (Index v = 0; v < head.size(); ++v) {
    if (!head[v] || (skin.mesh.positions[v] - ball.center).norm() < kOuterHead * ball.radius) continue;
    const float s = score(v);
    if (!(s > most)) continue;
    most = s;
    crown.vertex = v;
  }
  crown.place = soft_place(skin, crown.vertex, static_cast<double>(kDomeRadius * size),
                           [&](Index v) { return std::max(0.0F, kDome - (most - score(v))); });
  return crown;
}

}  // namespace bodice::anatomy
