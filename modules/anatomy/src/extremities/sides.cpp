#include "extremities/sides.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include <bodice/engine/parallel.hpp>

#include "skin/curve.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geodesic::Field;
using geodesic::Isoline;
using geometry::Index;
using geometry::Vec3;

/// The levels at which loops around a leg are read, as shares of the path from toe to perineum: calf and
/// knee.
constexpr std::array<float, 7> kLoopLevels{0.36F, 0.42F, 0.48F, 0.54F, 0.60F, 0.66F, 0.72F};
constexpr float kHeelFrom = 0.20F, kHeelTo = 0.29F, kCalf = 0.50F;  ///< as shares of that path

/// The weight of a meter through space against a meter along the skin, in the search for the heel. With 8 the
/// front of the ankle wins on a pointed foot, with 2 on an obese runner.
constexpr float kThroughSpace = 4.0F;

/// An upper bound of the distance between two points at these distances from the toe. A path over the toe
/// connects them, and an edge may be added at either end.
float over_the_toe(const Skin& skin, float first, float second) {
  return first + second + 2.0F * skin.graph.longest;
}

/// Distances from the loop around the calf at a level of the distance from the toe, which only the foot
/// needs.
Field distances_from_calf(const Skin& skin, const Field& from_toe, float level, float foot) {
  std::vector<geodesic::Seed> seeds;
  for (const auto& [a, b] : skin.edges.ends) {
    if ((from_toe[a] < level) == (from_toe[b] < level)) continue;
    const Index above = from_toe[a] < level ? b : a;
    seeds.push_back({above, from_toe[above] - level});
  }
  return geodesic::distances_within(skin.graph, seeds, over_the_toe(skin, level, foot));
}

/// Finds the heel, the vertex with the longest detour: the path toe - heel - head plus twice the path toe -
/// heel - calf. A bent knee shortens the first path over the back of the leg, a pointed foot the second.
/// Distance through space counts as well, because on a foot that is not pointed the heel is farther from the
/// toe than the front of the ankle.
Index find_heel(const Skin& skin, const Extremities& tips, Extremity foot, float leg) {
  const Field from_calf = distances_from_calf(skin, tips.field[foot], kCalf * leg, kHeelTo * leg);
  const Vec3& toe = skin.mesh.positions[tips.vertex[foot]];
  Index heel = tips.vertex[foot];
  float most = -1.0F;
  for (std::size_t v = 0; v < tips.field[foot].size(); ++v) {
    if (!(tips.field[foot][v] > kHeelFrom * leg && tips.field[foot][v] < kHeelTo * leg)) continue;
    const auto through_space = static_cast<float>((skin.mesh.positions[v] - toe).norm());
    const float detour = 3.0F * tips.field[foot][v] + tips.field[kHead][v] + 2.0F * from_calf[v] +
                         kThroughSpace * through_space;
    if (detour > most) {
      most = detour;
      heel = static_cast<Index>(v);
    }
  }
  return heel;
}

/// The direction around the loop in which the field is least: the negative first harmonic of the field over
/// arc length.
std::complex<double> least_direction(const Skin& skin, const Isoline& loop, const Field& field) {
  std::complex<double> harmonic = 0.0;
  double along = 0.0;
  const std::size_t n = loop.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double before = (loop.points[i] - loop.points[(i + n - 1) % n]).norm();
    const double after = (loop.points[(i + 1) % n] - loop.points[i]).norm();
    along += before;
    const double angle = 2.0 * std::numbers::pi * along / loop.girth_m;
    harmonic -=
        0.5 * (before + after) * static_cast<double>(value_at(skin, loop, i, field)) * std::polar(1.0, angle);
  }
  return harmonic / (loop.girth_m * loop.girth_m);
}

/// Sine of the angle from `first` to `second` around the loop, seen from the trunk.
double signed_turn(std::complex<double> first, std::complex<double> second) {
  const double size = std::abs(first) * std::abs(second);
  return size > 0.0 ? std::imag(second * std::conj(first)) / size : 0.0;
}

/// The weighted mean of reads(loop) over loops at levels of a field that rises toward the trunk. Lower loops
/// have larger weights, because a bent knee disturbs loops near it.
template <class Reads>
double mean_over_loops(const Skin& skin, const Field& field,
                       const std::array<float, kLoopLevels.size()>& levels, Reads reads) {
  double sum = 0.0, all = 0.0;
  const auto loops = geodesic::isolines(skin.mesh, skin.edges, field, levels);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto weight = static_cast<double>(loops.size() - i);
    all += weight;
    if (const Isoline* loop = widest_closed(loops[i])) sum += weight * reads(*loop);
  }
  return sum / all;
}

/// A number that is positive if the leg is the body's left one. Seen from the trunk, the inner side then
/// follows the back counter-clockwise. The heel gives the back, and the other foot the inner side, on loops
/// at equal distance from the toe.
double leftness(const Skin& skin, const Extremities& tips, Extremity foot, Extremity other) {
  const float leg = 0.5F * tips.feet_apart();
  const geodesic::Seed from{find_heel(skin, tips, foot, leg), 0.0F};
  const Field heel = geodesic::distances_within(skin.graph, {&from, 1},
                                                over_the_toe(skin, kHeelTo * leg, kLoopLevels.back() * leg));
  std::array<float, kLoopLevels.size()> levels{};
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = kLoopLevels[i] * leg;
  return mean_over_loops(skin, tips.field[foot], levels, [&](const Isoline& loop) {
    return turning(skin, loop, tips.field[foot]) *
           signed_turn(least_direction(skin, loop, heel), least_direction(skin, loop, tips.field[other]));
  });
}

}  // namespace

Sides find_sides(const engine::Context& context, const Skin& skin, const Extremities& tips) {
  std::array<double, 2> left{};
  engine::parallel_for(context, 2, 1, [&](std::size_t i, std::size_t) {
    left[i] = i == 0 ? leftness(skin, tips, kFootA, kFootB) : leftness(skin, tips, kFootB, kFootA);
  });
  const double difference = left[0] - left[1];
  return {difference >= 0.0, std::min(1.0, 0.5 * std::abs(difference))};
}

}  // namespace bodice::anatomy
