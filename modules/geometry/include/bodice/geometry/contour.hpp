// A closed surface around the region where a field is negative, on a grid of cubic cells.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// A field over space, negative inside. It changes by no more than the distance between two points: signed
/// distances, and their minima and maxima, do so.
using DistanceField = std::function<double(const Vec3&)>;

/// Values of a field at the nodes of a grid, x fastest.
struct FieldGrid {
  Vec3 low = Vec3::Zero();
  double cell_m = 0.0;
  std::array<std::size_t, 3> nodes{};  ///< along x, y and z
  std::vector<float> value;            ///< #nodes

  /// The index of a node in `value`.
  std::size_t index(std::size_t x, std::size_t y, std::size_t z) const {
    return (z * nodes[1] + y) * nodes[0] + x;
  }
};

/// Samples a field over a box, widened by two cells. Far from the surface a value has the right sign alone.
/// `field` is called from several threads. Cost: about one call for each 2 cells of the surface's area, times
/// the 8 cells of a block's depth.
FieldGrid sample_field(const engine::Context& context, const DistanceField& field, const Box& box,
                       double cell_m);

/// Samples fields that follow from one distance, on one grid: what a node needed before is kept. The fields
/// are `change(distance(p), p)`, and as if sampled by sample_field to the bit. 9 bytes a node.
class NodeDistances {
 public:
  using Change = std::function<double(double distance_m, const Vec3& p)>;

  /// The grid of sample_field() for this box and cell. No distance is taken yet.
  NodeDistances(DistanceField distance, const Box& box, double cell_m);

  /// The values of one of the fields. Distances that no field needed before are taken now, by several
  /// threads.
  FieldGrid sample(const engine::Context& context, const Change& change);

 private:
  static constexpr std::size_t kSides = 4;  ///< blocks of 1, 2, 4 and 8 nodes along each side

  double known(const Vec3& p, const std::array<std::size_t, 3>& first, std::size_t level);

  DistanceField distance_;
  FieldGrid empty_;                                     ///< the grid without values
  std::array<std::vector<double>, kSides> distance_m_;  ///< at each block's middle; NaN is not known yet
};

/// The same of an incomplete surface: values are signed distances, and the sign is that of the winding
/// number. It may change across a hole, far from any triangle, so that more of space is sampled.
FieldGrid sample_inside(const engine::Context& context, const MeshDistance& surface, const Box& box,
                        double cell_m);

/// The surface between negative and other values, wound outward and closed where the grid's border is not
/// negative: one vertex for each sheet of surface in a cell. Regions that touch along a cell's diagonal stay
/// apart. The order of vertices is that of the cells. O(#nodes).
TriMesh contour(const engine::Context& context, const FieldGrid& grid);

}  // namespace bodice::geometry
