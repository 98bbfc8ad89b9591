// Points near the skin with their exact signed distance, which the anytime tiers are fitted to.
#pragma once

#include <vector>

#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::fitting {

using geometry::Vec3;

/// A point and its distance to the skin.
struct DistanceSample {
  Vec3 point;
  double signed_distance_m = 0.0;  ///< to the skin, negative inside
  body::Part part = body::Part::kHead;
  bool one_sided = false;  ///< only a smaller distance is an error: other ellipsoids represent the skin there
};

/// How samples are drawn.
struct SampleOptions {
  std::size_t count = 0;
  double inward_m = 0.0, outward_m = 0.0;  ///< offsets along the skin's normal, drawn evenly in between
  double on_skin = 0.0;                    ///< fraction that lies on the skin itself
  double far = 0.0;                        ///< fraction pushed outward by outward_m to far_m instead
  double far_m = 0.0;
  std::uint64_t seed = 0;
};

/// The skin to fit to: that of the wanted parts, without triangles buried in other limbs.
struct SkinSource {
  const LabeledSkin& skin;
  std::uint32_t parts = 0;           ///< a bit for each wanted part
  std::vector<std::uint8_t> buried;  ///< #F
};

/// The skin of the wanted parts. If any part of the torso is wanted, the whole torso is, because its parts
/// share ellipsoids.
SkinSource make_skin_source(const engine::Context& context, const LabeledSkin& skin, std::uint32_t parts);

/// Draws samples as the options have it. Deterministic, parallel. About 2 microseconds a sample.
std::vector<DistanceSample> sample_near_skin(const engine::Context& context, const SkinSource& source,
                                             const SampleOptions& options);

/// A ball inside the body that touches the skin.
struct InscribedBall {
  Vec3 center, skin;  ///< its center, and the point where it touches the skin
  double radius_m = 0.0;
  body::Part part = body::Part::kHead;
};

/// The largest ball inside the body that touches the skin at each of about `count` even samples.
/// Based on: Jaehwan Ma, Sang Won Bae, Sunghee Choi. 3D medial axis point approximation using nearest
/// neighbors and the normal field. 2012. (shrinking balls) Differs: the closest point is one of the surface,
/// not of a point set.
std::vector<InscribedBall> inscribed_balls(const engine::Context& context, const SkinSource& source,
                                           std::size_t count, std::uint64_t seed);

}  // namespace bodice::fitting
