// Posing: a bound proxy follows the joints, frame by frame.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <bodice/binding/shape_offset.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/types.hpp>
#include <bodice/proxy/base_pose.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/proxy/posed_proxy.hpp>

namespace bodice::inline v0_1::binding {

/// Settings of one pose.
struct PoseOptions {
  /// Whether tables follow the skin. If not, ellipsoids are carried, and their tables stay as they are at
  /// rest.
  bool tables = true;
  /// Only tables of ellipsoids that come into one of these boxes (world, meters) follow the skin; all if
  /// absent. Tables outside of all keep what they were at rest.
  std::optional<std::span<const geometry::Box>> within;
  /// Ellipsoids are displaced by this share of their offsets (#E, or none), tables stay: a body that goes
  /// over from another shape to its own.
  std::span<const ShapeOffset> offsets;
  double offset_share = 0.0;
};

/// The joints of one bound proxy, and its current pose. Two poses are kept: while one is written, queries may
/// read the other. Posers are independent of each other; calls of one must not overlap.
class Poser {
 public:
  /// Fails with kInvalidArgument if the proxy is not bound. Starts in the bind pose.
  static engine::Result<Poser> make(const proxy::BodyProxy& bound);
  ~Poser();
  Poser(Poser&&) noexcept;
  Poser& operator=(Poser&&) noexcept;

  /// The number of joints, #J, that pose() takes.
  std::size_t joints() const noexcept;

  /// Moves the joints: joint space to world of each joint, #J, meters. A matrix may be off by rounding, up to
  /// a thousandth, which is mended, and carry a uniform scale. Fails with kInvalidArgument and names joint
  /// and reason where a matrix of a joint that moves skin is not finite, shears, mirrors or has no extent;
  /// then nothing moves. Joints that move no skin are not looked at. Allocates nothing but on failure. The
  /// same bits for any number of workers. Throws engine::Canceled, and then nothing moves.
  engine::Result<void> pose(const engine::Context& context, std::span<const proxy::JointMatrix> world,
                            const PoseOptions& options = {});
  /// The same for floats: rows of 3 x 4 matrices, `stride` floats from one matrix to the next.
  engine::Result<void> pose(const engine::Context& context, std::span<const float> world, std::size_t stride,
                            const PoseOptions& options = {});

  /// Adds tables that were solved in another pose (tryon::make_base_pose()). Tables of a pose are mixed from
  /// those of rest and of all base poses by how near their joints are: eq. (1) of pose/base_mix.hpp. The new
  /// ones count fully after `poses` calls of pose(), so that the surface does not jump. Six are held at a
  /// time; a further one replaces the least used. Fails with kInvalidArgument if it is of another proxy.
  /// Allocates; must not overlap another call.
  engine::Result<void> add_base(std::shared_ptr<const proxy::BasePose> base, int poses = 0);
  /// The same for tables that were made beforehand (proxy::ProxyWithBases): they count at once and stay.
  engine::Result<void> keep_base(std::shared_ptr<const proxy::BasePose> base);

  /// How far the joints of a pose are turned from those of the nearest base pose or of rest, for the
  /// ellipsoid for which this is farthest; radians, nearly. Zero for another number of joints. Allocates
  /// nothing.
  double departure_rad(std::span<const proxy::JointMatrix> world) noexcept;

  /// The pose of the last call, valid until the second next one.
  const proxy::PosedProxy& posed() const noexcept;
  /// The pose before, valid until the next call.
  const proxy::PosedProxy& previous() const noexcept;
  /// The proxy that this poses.
  const proxy::BodyProxy& bound() const noexcept;
  std::uint64_t poses() const noexcept;  ///< successful calls of pose()

 private:
  struct Impl;
  explicit Poser(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::binding
