// Finds the landmarks and the 15 parts of a skin: the paper's section 2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/body/landmark.hpp>
#include <bodice/body/part.hpp>
#include <bodice/body/proportions.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::anatomy {

/// What the analysis compares the body with.
struct Options {
  body::ProportionProfile profile;  ///< from body::find_profile("ansur2") or a file
  bool force = false;               ///< what contradicts a human body is a warning, not an error
  /// #V of the skin, or empty: 1 for vertices that close a hole. Creases that they hide are looked for.
  std::span<const std::uint8_t> made_up = {};
};

/// What is known of a body after its analysis.
struct Anatomy {
  double stature_m = 0.0;  ///< the height of the body if it stood, in the unit of the mesh: meters
  geometry::Vec3 up = geometry::Vec3::UnitY();  ///< feet to head along the trunk, unit
  std::vector<body::Landmark> landmarks;  ///< one each of LandmarkId; confidence 0 where nothing was found
  std::vector<body::Part> part;           ///< #V; every vertex has one
  std::vector<engine::Warning> warnings;
  std::vector<engine::StageTime> stages;  ///< skin, geodesic, anatomy, segment
};

/// Finds the landmarks and segments. Pose, position, rotation and scale of the mesh do not matter.
/// Fails with kUnusableGeometry when no body can be made out, or when what was found contradicts a human body
/// (plausible.hpp); the sentence names what was seen.
/// Precondition: a repaired mesh (geometry::repair). Deterministic for any worker count. Cost: about 30 ms of
/// one core for 8,500 vertices, and half a second for each thin copy that a skin with welded limbs needs.
engine::Result<Anatomy> analyze(const engine::Context& context, const geometry::TriMesh& skin,
                                const Options& options);

}  // namespace bodice::anatomy
