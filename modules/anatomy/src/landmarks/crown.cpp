#include "landmarks/crown.hpp"

#include <algorithm>
#include <cmath>

#include "coordinates/body_lengths.hpp"
#include "skin/soft_position.hpp"

namespace bodice::anatomy {
namespace {

using geodesic::Field;
using geometry::Index;
using geometry::Vec3;

/// Where the crown divides the way over the head from the back of the neck to its front: the same on children
/// and adults, whatever the size of the head.
constexpr float kFromNape = 0.485F;
/// What the square of a deviation from that share costs against distance from the feet, of the size. Without
/// it the forehead wins on bodies that lean back.
constexpr float kShareWeight = 2.0F;
/// How much of that score the dome of the head spans, and how far it reaches; of the size.
constexpr float kDome = 0.02F, kDomeRadius = 0.07F;

/// The body's lengths; the head's middle from breastbone and back, straight; its radius.
using HeadShift = Shift<std::tuple_size_v<BodyLengths> + 3>;
/// A head that is bent back folds the nape, which the way over it sees as a shorter head: the distances
/// through space tell how far it is bent.
constexpr HeadShift kUp{{0.0888, 0.0400, -0.0691, -0.1184, 0.4132, -0.1481, -0.3502, 0.1709, -0.2598}};
constexpr HeadShift kForward{{0.1184, 0.0833, -0.1153, -0.2011, 0.6603, -0.0783, -0.6170, 0.1521, -0.4501}};

Vec3 head_shift(const BodyCoordinates& coordinates, const Girth& neck, const Ball& head) {
  const Vec3 &front = coordinates.midline().front.position, &back = coordinates.midline().back.position;
  const auto size = static_cast<double>(coordinates.size_m());
  const BodyLengths b = body_lengths(coordinates);
  const std::array<double, b.size() + 3> lengths{b[0],
                                                 b[1],
                                                 b[2],
                                                 b[3],
                                                 b[4],
                                                 (head.center - front).norm() / size,
                                                 (head.center - back).norm() / size,
                                                 head.radius / size};
  const Vec3 up = (head.center - neck.center).normalized(), through = front - back;
  const Vec3 forward = (through - through.dot(up) * up).normalized();
  return size * (kUp(lengths) * up + kForward(lengths) * forward);
}

}  // namespace

Ball head_ball(const Skin& skin, const BodyCoordinates& coordinates) {
  std::vector<char> head(skin.mesh.positions.size());
  for (std::size_t v = 0; v < head.size(); ++v) head[v] = skin.component[v] == 0 && coordinates.on_head(v);
  return ball_of(skin, [&](Index v) { return head[v] != 0; });
}

Crown find_crown(const Skin& skin, const BodyCoordinates& coordinates, const Girth& neck, const Ball& head) {
  const BodyExtremities& ends = coordinates.extremities();
  const float size = coordinates.size_m();
  const Field &left = *ends.from_foot[0], &right = *ends.from_foot[1];
  const auto score = [&](Index v) {
    const float nape = coordinates.from_back()[v] - neck.from_back;
    const float throat = coordinates.from_front()[v] - neck.from_front;
    const float off = nape / std::max(nape + throat, 1e-6F * size) - kFromNape;
    return 0.5F * (left[v] + right[v]) / size - kShareWeight * off * off;
  };
  Crown crown{skin.mesh.positions[ends.head], ends.head};
  const bool has_head = head.radius > 0.0;
  if (neck.vertex == geometry::kNoIndex || !has_head) return crown;
  float most = -1.0F;
  for (Index v = 0; v < skin.mesh.positions.size(); ++v) {
    if ((skin.mesh.positions[v] - head.center).norm() < kOuterHead * head.radius) continue;
    if (skin.component[v] != 0 || !coordinates.on_head(v)) continue;
    const float s = score(v);
    if (!(s > most)) continue;
    most = s;
    crown.vertex = v;
  }
  // A hand over the head is nearer than the dome is wide, and farther from the feet.
  const auto dome = [&](Index v) {
    return coordinates.on_head(v) ? std::max(0.0F, kDome - (most - score(v))) : 0.0F;
  };
  crown.place = soft_position(skin, crown.vertex, static_cast<double>(kDomeRadius * size), dome) +
                head_shift(coordinates, neck, head);
  crown.vertex = vertex_near(skin, crown.place, crown.vertex);
  return crown;
}

}  // namespace bodice::anatomy
