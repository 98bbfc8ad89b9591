// Based on: Mingjun Yu, et al. (the paper's [20]) and the five extremities of the paper, section 2.1.
// Differs: farthest-point candidates are matched to a template of mutual distances, because plain farthest
// points take a heel, an elbow or a second toe in many poses.
#include "extremities/extremities.hpp"

#include <algorithm>
#include <cmath>

#include "extremities/extremity_template.hpp"
#include "skin/ball.hpp"
#include "skin/farthest_points.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geodesic::Field;
using geometry::Index;

constexpr std::size_t kCandidates = 8;
/// A candidate may be a heel or a thumb. The true extremity is within this distance of it, about a foot's
/// length.
constexpr float kRefineRadius = 0.2F;  // a fraction of the body size

/// Skin farther than this from the head's candidate does not belong to the head; a fraction of the body size.
constexpr float kHeadBall = 0.30F;
/// A vertex nearer to a hand than this share of the head candidate's distance belongs to an arm. It is needed
/// for an arm that is raised beside a heavy neck: the elbow lies within kHeadBall of the candidate, and
/// farther from the feet.
constexpr float kOffArms = 0.7F;
/// The height of the head below its highest vertex that the ball is fitted to; a fraction of the body size.
constexpr float kHeadHeight = 0.15F;

/// The vertex within `radius` of the extremity `end` with the largest distance from the extremities in
/// `from`, among vertices with may(v).
template <class May>
Index refine(const Extremities& tips, Extremity end, float radius, std::span<const Extremity> from, May may) {
  Index best = tips.vertex[end];
  float most = -1.0F;
  for (std::size_t v = 0; v < tips.field[end].size(); ++v) {
    if (!(tips.field[end][v] <= radius)) continue;
    float sum = 0.0F;
    for (const Extremity f : from) sum += tips.field[f][v];
    if (sum > most && may(v)) {
      most = sum;
      best = static_cast<Index>(v);
    }
  }
  return best;
}

/// A predicate: whether a vertex may belong to the head, by its distances from the candidate and from the
/// hands.
auto near_head(const Extremities& tips, float size) {
  const auto to_hand = [&tips](std::size_t v) {
    return std::min(tips.field[kHandA][v], tips.field[kHandB][v]);
  };
  const float least = kOffArms * to_hand(tips.vertex[kHead]);
  return [&tips, size, to_hand, least](std::size_t v) {
    return tips.field[kHead][v] <= kHeadBall * size && to_hand(v) >= least;
  };
}

/// The ball of the head: it is fitted to the vertices of the head that are at most kHeadHeight nearer to the
/// feet than its far end.
Ball head_ball(const Skin& skin, const Extremities& tips, float size) {
  const auto reach = [&](std::size_t v) { return 0.5F * (tips.field[kFootA][v] + tips.field[kFootB][v]); };
  const auto near = near_head(tips, size);
  float top = 0.0F;
  for (std::size_t v = 0; v < skin.mesh.positions.size(); ++v)
    if (near(v)) top = std::max(top, reach(v));
  const auto in_head = [&](std::size_t v) { return near(v) && reach(v) > top - kHeadHeight * size; };
  return ball_of(skin, in_head);
}

void refine_all(const engine::Context& context, const Skin& skin, float size, Extremities& tips) {
  constexpr std::array<Extremity, 2> feet{kFootA, kFootB};
  constexpr std::array<Extremity, 1> head{kHead};
  const Ball ball = head_ball(skin, tips, size);
  const auto near = near_head(tips, size);
  const auto outer = [&](std::size_t v) {
    return near(v) && (skin.mesh.positions[v] - ball.center).norm() >= kOuterHead * ball.radius;
  };
  std::array<Index, kExtremityCount> refined{};
  for (int e = 0; e < kExtremityCount; ++e)
    refined[e] = e == kHead ? refine(tips, kHead, kHeadBall * size, feet, outer)
                            : refine(tips, static_cast<Extremity>(e), kRefineRadius * size, head,
                                     [](std::size_t) { return true; });
  std::vector<Index> moved;
  std::vector<int> which;
  for (int e = 0; e < kExtremityCount; ++e)
    if (refined[e] != tips.vertex[e]) {
      moved.push_back(refined[e]);
      which.push_back(e);
    }
  std::vector<Field> fields = geodesic::distances_each(context, skin.graph, moved);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    tips.vertex[which[i]] = moved[i];
    tips.field[which[i]] = std::move(fields[i]);
  }
}

/// The distances along the skin between all points: n x n, row-major, meters.
std::vector<float> distances_between(const FarthestPoints& points) {
  const std::size_t n = points.vertex.size();
  std::vector<float> apart(n * n, 0.0F);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      apart[i * n + j] = apart[j * n + i] = points.field[j][points.vertex[i]];
  return apart;
}

/// Exchanges the hands if they are on the wrong sides. The path from an arm to the leg of its own side is the
/// shorter one; sums over both sides cancel the effect of a pose on one limb.
void pair_sides(Extremities& tips, float size) {
  const float same = tips.between(kHandA, kFootA) + tips.between(kHandB, kFootB);
  const float cross = tips.between(kHandA, kFootB) + tips.between(kHandB, kFootA);
  tips.side_margin = static_cast<double>(std::abs(cross - same) / size);
  if (same <= cross) return;
  std::swap(tips.vertex[kHandA], tips.vertex[kHandB]);
  std::swap(tips.field[kHandA], tips.field[kHandB]);
}

}  // namespace

std::optional<Extremities> find_extremities(const engine::Context& context, const Skin& skin) {
  FarthestPoints c = farthest_points(context, skin, kCandidates);
  const std::size_t n = c.vertex.size();
  if (n < kExtremityCount) return std::nullopt;
  const std::optional<TemplateMatch> match = match_template(distances_between(c), n);
  if (!match) return std::nullopt;
  Extremities tips;
  for (int e = 0; e < kExtremityCount; ++e) {
    tips.vertex[e] = c.vertex[match->candidate[e]];
    tips.field[e] = std::move(c.field[match->candidate[e]]);
    if (tips.field[e].empty()) tips.field[e] = geodesic::distances_from(skin.graph, tips.vertex[e]);
  }
  tips.mahalanobis = match->mahalanobis;
  const auto size = static_cast<float>(match->size_m);
  refine_all(context, skin, size, tips);
  pair_sides(tips, size);
  return tips;
}

}  // namespace bodice::anatomy
