// How well ellipsoids stand for a skin, whoever made them: by the exact signed distance, one judge for all.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/mesh_distance.hpp>

namespace paper_bench {

struct Approximation {
  /// The paper's measure, E_j: mean and worst over the ellipsoids. A vertex counts for the ellipsoid whose
  /// surface is nearest along the ray from its center, since a proxy does not tell its clusters.
  double radial_mean_mm = 0.0, radial_worst_mm = 0.0;
  double gap_mean_mm = 0.0, gap_p95_mm = 0.0;      ///< from the union's surface to the skin, by area
  double interior_percent = 0.0;                   ///< of the body's volume that is inside some ellipsoid
  double outside_percent = 0.0, outside_mm = 0.0;  ///< of the skin's area outside of all; its depth
  double leak_percent = 0.0;                       ///< of the points over 10 mm deep that no ellipsoid holds
};

/// Points that the judge looks at, made once a body.
class Judge {
 public:
  /// `samples` of the skin, and as many of the interior and of each union's surface.
  Judge(const bodice::engine::Context& context, const bodice::geometry::TriMesh& mesh, std::size_t samples);

  /// Deterministic.
  Approximation judge(std::span<const bodice::geometry::Ellipsoid> ellipsoids) const;
  const bodice::geometry::MeshDistance& distance() const { return distance_; }

 private:
  bodice::geometry::MeshDistance distance_;
  std::vector<bodice::geometry::Vec3> vertices_;
  std::size_t samples_;
  std::vector<bodice::geometry::Vec3> skin_, interior_, deep_;
};

}  // namespace paper_bench
