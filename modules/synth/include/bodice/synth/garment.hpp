// Garments cut to fit any segmented body: open surfaces of particles at a stated ease from the skin.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <bodice/body/landmark.hpp>
#include <bodice/body/part.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::synth {

/// The kind of a made garment.
enum class GarmentKind { kSkirt, kTunic, kPoncho, kTube };

/// The name of a kind in options: "skirt", "tunic", "poncho" or "tube".
constexpr std::string_view name(GarmentKind kind) {
  constexpr std::string_view kNames[] = {"skirt", "tunic", "poncho", "tube"};
  return kNames[static_cast<int>(kind)];
}

/// The body that a garment is made for: a skin with a part a vertex, and its landmarks.
struct SegmentedBody {
  const geometry::TriMesh& mesh;
  std::span<const body::Part> part;           ///< #V
  std::span<const body::Landmark> landmarks;  ///< one each of LandmarkId, in their order
  double stature_m = 0.0;
};

/// The kind and cut of a garment.
struct GarmentOptions {
  GarmentKind kind = GarmentKind::kSkirt;
  double ease_m = 0.008;  ///< least distance to the skin
  double edge_length_m = 0.015;
};

/// A made garment.
struct Garment {
  geometry::TriMesh mesh;
  std::vector<geometry::Index> pinned;  ///< vertices that the wearer holds (waistband); may be empty
};

/// Cuts a garment. Fails with kUnusableGeometry when the body does not allow the garment (a skirt needs legs,
/// for instance), and with kCanceled. Cost: a signed distance of each of the garment's
/// vertices, some milliseconds.
engine::Result<Garment> make_garment(const engine::Context& context, const SegmentedBody& body,
                                     const GarmentOptions& options);

}  // namespace bodice::synth
