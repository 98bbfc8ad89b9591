#include "skin/part_skin.hpp"

#include <algorithm>
#include <array>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/sampling.hpp>

#include "skin/touching_balls.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

/// The radius of the largest ball, a fraction of stature: no cross-section is thicker than a third of the
/// height.
constexpr double kMostRadius = 0.15;
constexpr double kNeighborhood = 0.02;  // fraction of stature: skin of other regions within it counts

/// Fills in the balls' radii and centers.
void grow_balls(PartSkin& part, double stature_m) {
  const std::size_t n = part.balls.size();
  if (n == 0) return;
  const Vec3 origin = part.balls.front().skin;
  std::array<std::vector<float>, 6> at;
  for (int j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      at[j].push_back(static_cast<float>((part.balls[i].skin[j] - origin[j]) / stature_m));
      at[3 + j].push_back(static_cast<float>(part.normals[i][j]));
    }
  std::vector<float> inward(n), outward(n);
  touching_radii({n, at[0].data(), at[1].data(), at[2].data(), at[3].data(), at[4].data(), at[5].data()},
                 static_cast<float>(kMostRadius), inward.data(), outward.data());
  part.outer_radius_m.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    InscribedBall& ball = part.balls[i];
    ball.radius_m = static_cast<double>(inward[i]) * stature_m;
    ball.center = ball.skin - ball.radius_m * part.normals[i];
    part.outer_radius_m[i] = static_cast<double>(outward[i]) * stature_m;
  }
}

}  // namespace

std::vector<PartSkin> sample_parts(const engine::Context& context, const LabeledSkin& skin,
                                   const std::vector<Region>& regions, std::size_t count) {
  std::array<std::size_t, body::kAllPartCount> region_of;
  region_of.fill(regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (int p = 0; p < body::kAllPartCount; ++p)
      if ((regions[r].parts >> p) & 1u) region_of[p] = r;
  std::vector<PartSkin> parts(regions.size());
  for (const geometry::SurfaceSample& s : geometry::sample_surface(skin.mesh, count, 3)) {
    const body::Part part = skin.part[skin.mesh.triangles[s.triangle][0]];
    const Vec3 normal = geometry::area_vector(skin.mesh, s.triangle).stableNormalized();
    const std::size_t r = region_of[static_cast<int>(part)];
    if (r == regions.size() || !(normal.squaredNorm() > 0.5)) continue;
    parts[r].normals.push_back(normal);
    parts[r].balls.push_back({s.point, s.point, 0.0, part});
  }
  engine::parallel_for(context, parts.size(), 1,
                       [&](std::size_t r, std::size_t) { grow_balls(parts[r], skin.stature_m); });
  return parts;
}

std::vector<DistanceSample> part_samples(const std::vector<PartSkin>& skins, std::size_t r,
                                         double stature_m) {
  const PartSkin& own = skins[r];
  const engine::Random random(5, r);
  const double mm = 1e-3 * stature_m / 1.7;
  std::vector<DistanceSample> samples;
  geometry::Box box;
  for (std::size_t i = 0; i < own.balls.size(); ++i) {
    const InscribedBall& ball = own.balls[i];
    box.extend(ball.skin);
    samples.push_back({ball.skin, 0.0, ball.part});
    // Every third sample is repeated off the skin, within the touching balls, where its distance is the
    // offset. Every tenth is repeated far off, so that no ellipsoid spreads in air that has no other samples.
    const bool near = i % 3 == 0, far = i % 10 == 5;
    if (!near && !far) continue;
    const double u = random.uniform_at(i);
    const double offset = std::clamp((far ? 20.0 + 180.0 * u : 40.0 * u - 10.0) * mm, -0.9 * ball.radius_m,
                                     0.9 * own.outer_radius_m[i]);
    samples.push_back({ball.skin + offset * own.normals[i], offset, ball.part});
  }
  const double reach = kNeighborhood * stature_m;
  for (std::size_t other = 0; other < skins.size(); ++other)
    for (const InscribedBall& ball : skins[other].balls)
      if (other != r && (ball.skin.array() > box.low.array() - reach).all() &&
          (ball.skin.array() < box.high.array() + reach).all())
        samples.push_back({ball.skin, 0.0, ball.part, true});
  return samples;
}

}  // namespace bodice::fitting
