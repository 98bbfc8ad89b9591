// Garments cut to fit any segmented body: open surfaces with thickness-free particles, a stated ease away
// from the skin.
#pragma once

#include <span>

#include <bodice/body/landmark.hpp>
#include <bodice/body/part.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::synth {

enum class GarmentKind { kSkirt, kTunic, kPoncho, kTube };

/// What a garment is made to fit: a skin with a part a vertex and its landmarks.
struct SegmentedBody {
  const geometry::TriMesh& mesh;
  std::span<const body::Part> part;  ///< #V
  std::span<const body::Landmark> landmarks;
  double stature_m = 0.0;
};

struct GarmentOptions {
  GarmentKind kind = GarmentKind::kSkirt;
  double ease_m = 0.008;  ///< least distance to the skin
  double edge_length_m = 0.015;
};

struct Garment {
  geometry::TriMesh mesh;
  std::vector<geometry::Index> pinned;  ///< vertices that the wearer holds (waistband); may be empty
};

/// Fails with kUnusableGeometry when the body's parts do not allow the garment (no legs for a skirt, say).
engine::Result<Garment> make_garment(const engine::Context& context, const SegmentedBody& body,
                                     const GarmentOptions& options);

}  // namespace bodice::synth
