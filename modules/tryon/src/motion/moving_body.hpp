// A body during frames: it stands still, or its joints pose it before each frame.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <bodice/binding/poser.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/tryon/motion.hpp>
#include <bodice/tryon/prepare.hpp>

#include "motion/shape_blend.hpp"

namespace bodice::inline v0_1::tryon {

/// A body's collider together with its skin in the same pose, which measures it. Not thread-safe. Keeps a
/// reference to the skin.
class MovingBody {
 public:
  /// `moves` false: the body stands still, whatever its proxy. The collider covers the skin at rest. Fails
  /// with kInvalidArgument where the body is to move and its proxy is not bound, or its skin has no rig.
  static engine::Result<MovingBody> make(const SegmentedSkin& skin, const proxy::BodyProxy& proxy,
                                         bool moves);

  bool moves() const noexcept { return poser_.has_value(); }
  /// Poses the collider by the joints, #J. Contacts then use the velocity of a surface that moved there
  /// within dt_s. Outside of the boxes `options.within` tables stay as at rest; inside, relief covers the
  /// skin. Fails where a matrix is refused, and then changes nothing. Allocates nothing.
  engine::Result<void> pose(const engine::Context& context, std::span<const rig::Affine> joints, double dt_s,
                            const binding::PoseOptions& options = {});

  /// Adds base poses with tables that later poses use. Fails where one belongs to another body.
  engine::Result<void> keep_bases(const proxy::BasePoses& bases);

  /// Starts a blend from the present shape of another body of the same vertices to this body's own.
  void start_blend_from(const MovingBody& before) { blend_.begin(before.blend_); }
  /// The share of the earlier shape in the blend: 1 at first, 0 at the end.
  double blend_share() const noexcept { return blend_.share(); }
  /// Advances the blend by dt_s; the next pose() shows it.
  void advance_blend(double dt_s) { blend_.advance(dt_s); }
  /// Shows the blend on a body that stands still or is in its bind pose.
  void show_shape(const engine::Context& context);

  /// Null where the body stands still.
  binding::Poser* poser() noexcept { return poser_ ? &*poser_ : nullptr; }

  const collision::Collider& collider() const noexcept { return collider_; }
  /// The skin in the current pose, computed at the first call in each pose.
  const geometry::TriMesh& skin(const engine::Context& context);
  /// The same during a blend of shapes. Writes as many positions as `out` has.
  void skin_positions(std::span<geometry::Vec3> out);
  /// The exact distance to skin(). It is built anew at the first call in each pose.
  const geometry::MeshDistance& distance(const engine::Context& context);
  /// Moves points that were attached to the skin in the bind pose into the current pose; all lists have one
  /// element for each point.
  void carry(std::span<const geometry::Vec3> bound, const rig::SkinWeights& weights,
             std::span<geometry::Vec3> posed) const;

 private:
  MovingBody(const SegmentedSkin& skin, const proxy::BodyProxy& proxy)
      : skin_(&skin), collider_(proxy), blend_(proxy, skin.input.skin.positions) {}

  /// Raises the collider where the skin in the pose in force is outside of it.
  void cover(const engine::Context& context, std::optional<std::span<const geometry::Box>> within);

  const SegmentedSkin* skin_;
  collision::Collider collider_;
  ShapeBlend blend_;
  std::vector<rig::Affine> bind_;        // #J; empty where the body stands still
  std::vector<geometry::Vec3> at_rest_;  // #V; scratch
  std::optional<binding::Poser> poser_;
  std::vector<rig::Affine> skinning_;               // #J
  std::vector<rig::Affine> with_still_;             // #J + 1; empty without things on proxy::kStillJoint
  geometry::TriMesh posed_;                         // empty where the body stands still
  bool is_skinned_ = false;                         // whether posed_ is of the pose in force
  std::optional<geometry::MeshDistance> distance_;  // of posed_, built at the first call
};

}  // namespace bodice::tryon
