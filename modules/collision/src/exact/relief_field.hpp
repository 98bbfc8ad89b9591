// The distance F corrected by relief (model/relief_tables.hpp) in double precision: the reference of the
// exact side for proxies with tables.
#pragma once

#include "exact/union_field.hpp"
#include "model/relief_tables.hpp"

namespace bodice::inline v0_1::collision {

/// Values h and a of one table at a unit direction, and their slopes there.
struct TableValue {
  double h_m = 0.0, a_per_m = 0.0;
  geometry::Vec3 h_slope = geometry::Vec3::Zero(), a_slope = geometry::Vec3::Zero();  ///< d / dw
};
TableValue read_table(const ReliefTables& relief, const BakedTable& table, const geometry::Vec3& w);

/// The four texels between which a table is read at an ellipsoid's closest point, counted from the table's
/// own first texel, and their weights.
struct TexelStencil {
  std::size_t texel[4];
  double weight[4];
};
TexelStencil texels_around(const UnionField& field, const ReliefTables& relief, std::uint32_t k,
                           const geometry::ClosestPoint& at);

/// A distance with its gradient and owner.
struct ReliefSample {
  double distance_m = 0.0;                            ///< F, margin not subtracted
  geometry::Vec3 gradient = geometry::Vec3::UnitX();  ///< gradient of F with the weights held constant
  std::uint32_t owner = kNoEllipsoid;
};

/// Corrected distance F_k of one ellipsoid at a point, given the ellipsoid's closest point to it.
ReliefSample correct(const UnionField& field, const ReliefTables& relief, std::uint32_t k,
                     const geometry::ClosestPoint& at);

/// The score of one ellipsoid at a point, given the ellipsoid's closest point to it: d_k + kappa b_k where
/// burial counts, else d_k.
double score_of(const UnionField& field, const ReliefTables& relief, std::uint32_t k,
                const geometry::ClosestPoint& at);

/// Corrected distance F at p. For a proxy without ellipsoids there is no owner and the distance is +infinity.
/// Cost: O(#ellipsoids).
ReliefSample relief_sample(const UnionField& field, const ReliefTables& relief, const geometry::Vec3& p);

}  // namespace bodice::collision
