// Where the tables of a bound proxy are read in a pose: what a refit solves for (fitting/refit.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/proxy/table_reading.hpp>

namespace bodice::inline v0_1::binding {

/// The carried ellipsoids of a pose, and how their tables follow the skin there: what Poser writes into
/// texels, as a function of the direction. Reading is thread-safe.
class TableWarp {
 public:
  /// Fails as Poser::pose() does. `world` is joint space to world of each joint, #J.
  static engine::Result<TableWarp> make(const engine::Context& context, const proxy::BodyProxy& bound,
                                        std::span<const proxy::JointMatrix> world);
  ~TableWarp();
  TableWarp(TableWarp&&) noexcept;
  TableWarp& operator=(TableWarp&&) noexcept;

  std::span<const geometry::Ellipsoid> shapes() const noexcept;  ///< #E, world
  double scale() const noexcept;                                 ///< size of the body over its size at rest
  /// The reading at a unit direction of the posed ellipsoid. A microsecond at most.
  proxy::TableReading read(std::uint32_t ellipsoid, const geometry::Vec3& direction) const;
  /// Whether the table of an ellipsoid follows the skin. Others are the same in every pose.
  bool follows(std::uint32_t ellipsoid) const noexcept;

 private:
  struct Impl;
  explicit TableWarp(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::binding
