// Based on: Mingjun Yu, et al. (the paper's [20]) and the five ends of the paper, section 2.1.
// Differs: farthest-point candidates are matched to a template of mutual distances, because plain farthest
// points take a heel, an elbow or a second toe in many poses.
#include "extremities/extremities.hpp"

#include <algorithm>
#include <cmath>

#include "extremities/extremity_template.hpp"
#include "skin/ball.hpp"
#include "skin/farthest_points.hpp"

namespace bodice::anatomy {
namespace {

using geodesic::Field;
using geometry::Index;

constexpr std::size_t kCandidates = 8;
/// A candidate may be a heel or a thumb; the true end is within a foot's length of it.
constexpr float kRefineRadius = 0.2F;  // of the size

constexpr float kHeadBall = 0.30F;  // of the size
/// What is this much nearer to a hand than the head's candidate, as a part of the candidate's way, is its
/// arm: the elbow of an arm that is raised beside a heavy neck lies within the head's reach, and farther from
/// the feet.
constexpr float kOffArms = 0.7F;
/// What counts as head for its ball, from the crown down, of the size.
constexpr float kHeadHeight = 0.15F;

/// The vertex within `radius` of `end` that is farthest from the ends in `from`, among those that `may` be
/// it.
template <class May>
Index refine(const EndPoints& ends, End end, float radius, std::span<const End> from, May may) {
  Index best = ends.vertex[end];
  float most = -1.0F;
  for (std::size_t v = 0; v < ends.field[end].size(); ++v) {
    if (!(ends.field[end][v] <= radius)) continue;
    float sum = 0.0F;
    for (const End f : from) sum += ends.field[f][v];
    if (sum > most && may(v)) {
      most = sum;
      best = static_cast<Index>(v);
    }
  }
  return best;
}

/// What may be of the head, by its distance from the candidate and from the hands.
auto near_head(const EndPoints& ends, float size) {
  const auto to_hand = [&ends](std::size_t v) {
    return std::min(ends.field[kHandA][v], ends.field[kHandB][v]);
  };
  const float least = kOffArms * to_hand(ends.vertex[kHead]);
  return [&ends, size, to_hand, least](std::size_t v) {
    return ends.field[kHead][v] <= kHeadBall * size && to_hand(v) >= least;
  };
}

/// The head as a ball: what lies no nearer to the feet than a head's height below its far end.
Ball head_ball(const Skin& skin, const EndPoints& ends, float size) {
  const auto reach = [&](std::size_t v) { return 0.5F * (ends.field[kFootA][v] + ends.field[kFootB][v]); };
  const auto near = near_head(ends, size);
  float top = 0.0F;
  for (std::size_t v = 0; v < skin.mesh.positions.size(); ++v)
    if (near(v)) top = std::max(top, reach(v));
  const auto in_head = [&](std::size_t v) { return near(v) && reach(v) > top - kHeadHeight * size; };
  return ball_of(skin, in_head);
}

void refine_all(const engine::Context& context, const Skin& skin, float size, EndPoints& ends) {
  constexpr std::array<End, 2> feet{kFootA, kFootB};
  constexpr std::array<End, 1> head{kHead};
  const Ball ball = head_ball(skin, ends, size);
  const auto near = near_head(ends, size);
  const auto outer = [&](std::size_t v) {
    return near(v) && (skin.mesh.positions[v] - ball.center).norm() >= kOuterHead * ball.radius;
  };
  std::array<Index, kEndCount> refined{};
  for (int e = 0; e < kEndCount; ++e)
    refined[e] = e == kHead ? refine(ends, kHead, kHeadBall * size, feet, outer)
                            : refine(ends, static_cast<End>(e), kRefineRadius * size, head,
                                     [](std::size_t) { return true; });
  std::vector<Index> moved;
  std::vector<int> which;
  for (int e = 0; e < kEndCount; ++e)
    if (refined[e] != ends.vertex[e]) {
      moved.push_back(refined[e]);
      which.push_back(e);
    }
  std::vector<Field> fields = geodesic::distances_each(context, skin.graph, moved);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    ends.vertex[which[i]] = moved[i];
    ends.field[which[i]] = std::move(fields[i]);
  }
}

/// n x n, row-major, meters.
std::vector<float> distances_between(const FarthestPoints& points) {
  const std::size_t n = points.vertex.size();
  std::vector<float> apart(n * n, 0.0F);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      apart[i * n + j] = apart[j * n + i] = points.field[j][points.vertex[i]];
  return apart;
}

/// An arm's way to the leg of its own side is shorter. Sums over both sides cancel what a pose does to one
/// limb.
void pair_sides(EndPoints& ends, float size) {
  const float same = ends.between(kHandA, kFootA) + ends.between(kHandB, kFootB);
  const float cross = ends.between(kHandA, kFootB) + ends.between(kHandB, kFootA);
  ends.side_margin = static_cast<double>(std::abs(cross - same) / size);
  if (same <= cross) return;
  std::swap(ends.vertex[kHandA], ends.vertex[kHandB]);
  std::swap(ends.field[kHandA], ends.field[kHandB]);
}

}  // namespace

std::optional<EndPoints> find_end_points(const engine::Context& context, const Skin& skin) {
  FarthestPoints c = farthest_points(context, skin, kCandidates);
  const std::size_t n = c.vertex.size();
  if (n < kEndCount) return std::nullopt;
  const std::optional<EndMatch> match = match_ends(distances_between(c), n);
  if (!match) return std::nullopt;
  EndPoints ends;
  for (int e = 0; e < kEndCount; ++e) {
    ends.vertex[e] = c.vertex[match->candidate[e]];
    ends.field[e] = std::move(c.field[match->candidate[e]]);
    if (ends.field[e].empty()) ends.field[e] = geodesic::distances_from(skin.graph, ends.vertex[e]);
  }
  ends.misfit = match->misfit;
  const auto size = static_cast<float>(match->size_m);
  refine_all(context, skin, size, ends);
  pair_sides(ends, size);
  return ends;
}

}  // namespace bodice::anatomy
