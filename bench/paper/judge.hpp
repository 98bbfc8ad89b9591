// How well ellipsoids approximate a skin, measured alike for every method by the exact signed distance.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/mesh_distance.hpp>

namespace paper_bench {

/// The errors of a set of ellipsoids against a skin.
struct Approximation {
  /// Mean and maximum over the ellipsoids of the mean radial error, eq. (6). A vertex counts for the
  /// ellipsoid with the nearest surface along the ray from its center, because a proxy has no clusters.
  double radial_mean_mm = 0.0, radial_worst_mm = 0.0;
  double gap_mean_mm = 0.0, gap_p95_mm = 0.0;      ///< from the union's surface to the skin, by area
  double interior_percent = 0.0;                   ///< share of the body's volume inside some ellipsoid
  double outside_percent = 0.0, outside_mm = 0.0;  ///< share of the skin's area outside of all; its distance
  double leak_percent = 0.0;  ///< share of the points over 10 mm deep that no ellipsoid holds
};

/// Measures sets of ellipsoids against one body, on points that are sampled once.
class Judge {
 public:
  /// Takes `samples` points of the skin, as many of the interior, and about as many of each union's surface.
  Judge(const bodice::engine::Context& context, const bodice::geometry::TriMesh& mesh, std::size_t samples);

  /// Measures the ellipsoids; deterministic.
  Approximation judge(std::span<const bodice::geometry::Ellipsoid> ellipsoids) const;
  const bodice::geometry::MeshDistance& distance() const { return distance_; }

 private:
  bodice::geometry::MeshDistance distance_;
  std::vector<bodice::geometry::Vec3> vertices_;
  std::size_t samples_;
  std::vector<bodice::geometry::Vec3> skin_, interior_, deep_;
};

}  // namespace paper_bench
