// Points near the skin with their exact signed distance: what the anytime tiers are fitted to.
#pragma once

#include <vector>

#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::fitting {

using geometry::Vec3;

struct DistanceSample {
  Vec3 point;
  double signed_distance_m = 0.0;  ///< to the skin, negative inside
  body::Part part = body::Part::kHead;
  bool one_sided = false;  ///< asks only not to be nearer than it is: skin that others stand for
};

struct SampleOptions {
  std::size_t count = 0;
  double inward_m = 0.0, outward_m = 0.0;  ///< offsets along the skin's normal, drawn evenly in between
  double on_skin = 0.0;                    ///< fraction that lies on the skin itself
  double far = 0.0;                        ///< fraction pushed outward by outward_m to far_m instead
  double far_m = 0.0;
  std::uint64_t seed = 0;
};

/// The skin that counts: that of the wanted parts, less what is buried in other limbs.
struct SkinSource {
  const LabeledSkin& skin;
  std::uint32_t parts = 0;
  std::vector<std::uint8_t> buried;  ///< #F
};
/// With the whole torso if any part of it is wanted: its ellipsoids are shared.
SkinSource make_skin_source(const engine::Context& context, const LabeledSkin& skin, std::uint32_t parts);

/// Deterministic, parallel. About 2 microseconds a sample.
std::vector<DistanceSample> sample_near_skin(const engine::Context& context, const SkinSource& source,
                                             const SampleOptions& options);

struct InscribedBall {
  Vec3 center, skin;  ///< it touches the skin there
  double radius_m = 0.0;
  body::Part part = body::Part::kHead;
};

/// The largest ball inside the body that touches the skin at each of about `count` even samples.
/// Based on: Jaehwan Ma, Sang Won Bae, Sunghee Choi. 3D medial axis point approximation using nearest
/// neighbors and the normal field. 2012. (shrinking balls) Differs: closest point of the surface, not of a
/// point set.
std::vector<InscribedBall> inscribed_balls(const engine::Context& context, const SkinSource& source,
                                           std::size_t count, std::uint64_t seed);

}  // namespace bodice::fitting
