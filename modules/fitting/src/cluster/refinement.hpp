// Bisecting refinement of one region: the paper's steps a to e.
// Based on: the paper, section 3.3. Differs: it ends at a count as well as at a threshold. A cluster is
// fitted again only if its members changed, and only when it is next to be split or at the end. A cluster
// that is too small to split stays, so that refinement always ends.
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

namespace bodice::inline v0_1::fitting {

using geometry::Index;
using geometry::Vec3;

/// What is clustered: vertices or triangles.
struct Items {
  std::vector<Vec3> where;     ///< #I: the point of the item in K-means
  std::vector<double> weight;  ///< #I
  /// #I: indices into `points` of those that the item's ellipsoid must hold (may repeat). Empty: `where`
  /// itself.
  std::vector<std::array<Index, 3>> encloses;
  std::vector<body::Part> part;  ///< #I
  std::vector<Index> triangle;   ///< #I: the mesh's triangle, where items are triangles
  std::vector<Vec3> points;      ///< indexed by `encloses`
};

/// Parts that are fitted together: the torso's six parts, or one other part.
struct Region {
  std::string_view name;
  std::uint32_t parts = 0;  ///< a bit for each part
  bool torso = false;
  std::vector<Index> items;
  std::vector<Vec3> seeds;  ///< initial centers: six for the torso, else one
};

/// How a region is refined.
struct RefineOptions {
  double sigma_m = 0.0;       ///< eq. (7): K-means stops when no center moves farther
  double min_radius_m = 0.0;  ///< no semi-axis of an ellipsoid is shorter
  bool reclassify = false;    ///< whether points are reclassified by eq. (8)
};

/// The least radius of an enclosing ellipsoid, a fraction of stature: half a millimeter.
inline constexpr double kLeastRadius = 3e-4;

/// Options for a body of this stature. Centers that move less than two thousandths of stature no longer
/// change which ellipsoid fits.
inline RefineOptions refine_options(double stature_m) {
  return {.sigma_m = 2e-3 * stature_m, .min_radius_m = kLeastRadius * stature_m};
}

/// Items with their enclosing ellipsoid.
struct Cluster {
  std::vector<Index> items;  ///< ascending
  geometry::Ellipsoid ellipsoid;
  double error_m = 0.0;                 ///< E_j, eq. (6), over its points
  body::Part part = body::Part::kHead;  ///< the part of most of its items
  bool fitted = false;                  ///< false: ellipsoid and error belong to an earlier set of items
};

/// The points that the ellipsoid of these items must hold, each once.
std::vector<Vec3> enclosed_points(const Items& items, std::span<const Index> members);

/// Distance between a point and the ellipsoid along the ray from the center; the least radius at the center.
double radial_distance(const geometry::Ellipsoid& ellipsoid, const Vec3& point);

/// Eq. (6): the mean radial distance between the points and the ellipsoid; zero without points.
double radial_error(const geometry::Ellipsoid& ellipsoid, std::span<const Vec3> points);

/// The refinement of one region.
class Refinement {
 public:
  /// The region and the items must outlive the refinement.
  Refinement(const engine::Context& context, const Items& items, const Region& region,
             const RefineOptions& options);
  Refinement(const Refinement&) = delete;
  Refinement& operator=(const Refinement&) = delete;

  /// The clusters; all are fitted after run().
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
  std::vector<Vec3> where_;  ///< #items of the region
  std::vector<double> weight_;
  Lloyd lloyd_;
  std::vector<Vec3> centers_;
  std::vector<Cluster> clusters_;
};

}  // namespace bodice::fitting
