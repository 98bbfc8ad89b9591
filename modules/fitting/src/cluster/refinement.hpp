// Bisecting refinement of one region: the paper's steps a to e.
// Based on: the paper, section 3.3. Differs: ends at a count as well as at a threshold; only clusters whose
// members changed are fitted again, and that only when they are next to be split or at the end; a cluster too
// small to split is left alone, so refinement always ends.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>

#include "cluster/lloyd.hpp"

namespace bodice::fitting {

using geometry::Index;
using geometry::Vec3;

/// What is clustered: vertices, triangles or interior anchors.
struct Items {
  std::vector<Vec3> where;     ///< #I, the point that K-means sees
  std::vector<double> weight;  ///< #I
  /// #I, points that the item's ellipsoid must hold (may repeat); empty: `where` itself.
  std::vector<std::array<Index, 3>> encloses;
  std::vector<body::Part> part;  ///< #I
  std::vector<Index> triangle;   ///< #I, of the mesh, where items are triangles
  std::vector<Vec3> points;      ///< what `encloses` indexes
};

/// Parts that are fitted together: the torso's six, or one limb.
struct Region {
  std::string_view name;
  std::uint32_t parts = 0;  ///< bit a part
  bool torso = false;
  std::vector<Index> items;
  std::vector<Vec3> seeds;  ///< initial centers: 6 for the torso, else 1
};

struct RefineOptions {
  double sigma_m = 0.0;       ///< pruned stop
  double min_radius_m = 0.0;  ///< of every ellipsoid
  bool reclassify = false;    ///< eq. (8)
};

/// No enclosing ellipsoid is thinner: a fraction of stature, half a millimeter.
inline constexpr double kLeastRadius = 3e-4;

/// Pruned stop: centers that move less than 2 parts in 1000 of stature no longer change which ellipsoid fits.
inline RefineOptions refine_options(double stature_m) {
  return {.sigma_m = 2e-3 * stature_m, .min_radius_m = kLeastRadius * stature_m};
}

struct Cluster {
  std::vector<Index> items;  ///< ascending
  geometry::Ellipsoid ellipsoid;
  double error_m = 0.0;  ///< E_j, eq. (6), over its points
  body::Part part = body::Part::kHead;
  bool fitted = false;  ///< false: ellipsoid and error are those of the points it had before
};

/// The points that these items' ellipsoid must hold, each once.
std::vector<Vec3> enclosed_points(const Items& items, std::span<const Index> members);

/// Along the ray from the center, between a point and the ellipsoid.
double radial_distance(const geometry::Ellipsoid& ellipsoid, const Vec3& point);

/// Eq. (6): mean distance along the ray from the center between the points and the ellipsoid.
double radial_error(const geometry::Ellipsoid& ellipsoid, std::span<const Vec3> points);

class Refinement {
 public:
  /// The region and the items must outlive the refinement.
  Refinement(const engine::Context& context, const Items& items, const Region& region,
             const RefineOptions& options);
  Refinement(const Refinement&) = delete;
  Refinement& operator=(const Refinement&) = delete;

  /// All fitted once the refinement has run.
  const std::vector<Cluster>& clusters() const { return clusters_; }
  /// Steps b to e: splits until every error is at most `mu_m` or there are `most` clusters.
  void run(double mu_m, std::size_t most);

 private:
  std::size_t find_worst();
  void split(std::size_t worst);
  void recluster(std::vector<Vec3> centers);
  void fit(std::span<const std::size_t> which);
  void fit_rest();
  void reclassify();
  void set_members(std::vector<std::vector<Index>> members);
  Lloyd fresh_lloyd() const;

  const engine::Context& context_;
  const Items& items_;
  const Region& region_;
  RefineOptions options_;
  std::vector<Vec3> where_;  ///< of the region's items
  std::vector<double> weight_;
  Lloyd lloyd_;
  std::vector<Vec3> centers_;
  std::vector<Cluster> clusters_;
};

}  // namespace bodice::fitting
