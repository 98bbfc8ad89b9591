// Bisecting refinement of one region: the paper's steps a to e.
// Based on: the paper, section 3.3. Differs: steps are driven from outside, so that one budget can be spent
// over all regions, worst ellipsoid first; only clusters whose members changed are fitted again; a cluster
// too small to split is left alone, so refinement always ends.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::fitting {

using geometry::Index;
using geometry::Vec3;

/// What is clustered: vertices, triangles or interior anchors.
struct Items {
  std::vector<Vec3> where;     ///< #I, the point that K-means sees
  std::vector<double> weight;  ///< #I
  std::vector<std::array<Index, 3>>
      encloses;                       ///< #I, points that the item's ellipsoid must hold (may repeat)
  std::vector<std::uint8_t> is_skin;  ///< #I, takes part in the fit error
  std::vector<body::Part> part;       ///< #I
  std::vector<Vec3> points;           ///< what `encloses` indexes
};

struct Region {
  bool torso = false;
  std::vector<Index> items;
  std::vector<Vec3> seeds;  ///< initial centres: 6 for the torso, else 1
};

struct RefineOptions {
  double sigma_m = 0.0;       ///< pruned stop
  double min_radius_m = 0.0;  ///< of every ellipsoid
  bool reclassify = false;    ///< eq. (8)
};

struct Cluster {
  std::vector<Index> items;  ///< ascending
  geometry::Ellipsoid ellipsoid;
  double error_m = 0.0;  ///< E_j, eq. (6), over its skin points
  body::Part part = body::Part::kHead;
};

/// Eq. (6): mean distance along the ray from the centre between the points and the ellipsoid.
double radial_error(const geometry::Ellipsoid& ellipsoid, std::span<const Vec3> points);

class Refinement {
 public:
  Refinement(const engine::Context& context, const Items& items, Region region, const RefineOptions& options);

  const Region& region() const { return region_; }
  const std::vector<Cluster>& clusters() const { return clusters_; }
  /// E of the worst cluster that can still be split, or 0 when none can.
  double worst_error() const;
  /// Steps b to d. Does nothing when no cluster can be split.
  void split_worst();

 private:
  void recluster(std::vector<Vec3> centers);
  void fit(Cluster& cluster) const;
  std::vector<Vec3> skin_points(const Cluster& cluster) const;
  void reclassify();
  void set_members(std::vector<std::vector<Index>> members);

  const engine::Context& context_;
  const Items& items_;
  Region region_;
  RefineOptions options_;
  std::vector<Vec3> where_;  ///< of the region's items
  std::vector<double> weight_;
  std::vector<Vec3> centers_;
  std::vector<Cluster> clusters_;
};

}  // namespace bodice::fitting
