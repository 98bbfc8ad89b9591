// The tables of a proxy solved anew for another pose or shape of the same skin, while its ellipsoids stay as
// they were carried there.
//
// A table at rest is read, in a pose, at the direction u(w) of the material that is at direction w now, and
// the skin has grown over the ellipsoid by growth(u). With s the scale of the ellipsoid, a reading is
//   (1)  F = d - s h(u) - growth - (s a(u) - 0) clamp(d) / out + growth a(u) / out
// which is linear in h and a. A refit adds corrections to h and a such that the blended distance, eq. (5') of
// proxy/posed_proxy.hpp, is that to the skin of the pose. Since corrections belong to directions at rest,
// tables of several poses can be mixed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/proxy/table_reading.hpp>

namespace bodice::inline v0_1::fitting {

/// The tables of a pose, as far as a refit needs them. Calls come from many threads.
class PosedTables {
 public:
  virtual ~PosedTables() = default;
  /// The reading of an ellipsoid's table at a unit direction of the posed ellipsoid.
  virtual proxy::TableReading read(std::uint32_t ellipsoid, const geometry::Vec3& direction) const = 0;
  /// Whether the table of an ellipsoid may be changed; others count as they are.
  virtual bool is_free(std::uint32_t ellipsoid) const = 0;
};

/// Carried ellipsoids, and the tables that are to be solved anew for them.
struct RefitInput {
  const proxy::BodyProxy& rest;                 ///< of tier relief
  std::span<const geometry::Ellipsoid> shapes;  ///< #E: the ellipsoids of `rest` in the pose
  const PosedTables& tables;
  double scale = 1.0;  ///< size of the posed body over its size at rest
};

/// Tables in the layout of the proxy's own.
struct RefitTables {
  std::vector<proxy::ReliefTable> relief;  ///< #E
  std::vector<proxy::ReliefTexel> texels;  ///< #X
};

/// Solves the tables for the skin in its pose. Fails with kInvalidArgument where the proxy has no tables or
/// the numbers of ellipsoids differ, and with kCanceled. The same bits for any number of workers. Takes some
/// .2 s of one core for 13,000 vertices and 89 ellipsoids.
engine::Result<RefitTables> refit_tables(const engine::Context& context, const LabeledSkin& posed,
                                         const RefitInput& input);

/// Carries ellipsoids to another shape of the skin that they stand for (`from`: its vertices before, #V),
/// each by the affine map that its skin takes best, without the map's shear: axes keep their order, so that
/// tables are read as before. #E. Deterministic, parallel. Some 20 milliseconds of one core.
std::vector<geometry::Ellipsoid> carry_ellipsoids(const engine::Context& context,
                                                  std::span<const proxy::ProxyEllipsoid> ellipsoids,
                                                  std::span<const geometry::Vec3> from,
                                                  const LabeledSkin& to);

}  // namespace bodice::fitting
