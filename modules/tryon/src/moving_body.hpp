// The body of a drape as its frames see it: standing still, or posed by a clip before each frame.
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

namespace bodice::tryon {

/// A collider with the skin that judges it. Not thread-safe.
class MovingBody {
 public:
  /// `motion` null: the body stands still. Keeps references to both. Fails with kInvalidArgument where the
  /// body is to move and its proxy is not bound.
  static engine::Result<MovingBody> make(const PreparedBody& body, const BodyMotion* motion, double ramp_s,
                                         bool loop);

  bool moves() const noexcept { return player_.has_value(); }
  /// Seconds of the clip at which the ramp begins; 0 or less.
  double begin_s() const noexcept { return player_ ? -player_->ramp_s() : 0.0; }
  /// Poses collider and skin; contacts then know the velocity of a surface that came here in dt_s.
  engine::Result<void> pose(const engine::Context& context, double time_s, double dt_s);

  const collision::Collider& collider() const noexcept { return collider_; }
  /// The skin in the pose in force.
  const geometry::TriMesh& skin() const noexcept { return moves() ? posed_ : body_->skin.input.skin; }
  /// Exact, of skin(). Built anew in each pose in which it is called.
  const geometry::MeshDistance& distance(const engine::Context& context);
  /// Carries points that were attached to the skin in the bind pose into the pose in force, #points each.
  void carry(std::span<const geometry::Vec3> bound, const rig::SkinWeights& weights,
             std::span<geometry::Vec3> posed) const;

 private:
  explicit MovingBody(const PreparedBody& body) : body_(&body), collider_(body.fit.proxy) {}

  const PreparedBody* body_;
  const BodyMotion* motion_ = nullptr;
  collision::Collider collider_;
  std::optional<MotionPlayer> player_;
  std::optional<binding::Poser> poser_;
  std::vector<rig::Affine> joints_, skinning_;      // #J
  geometry::TriMesh posed_;                         // empty where the body stands still
  std::optional<geometry::MeshDistance> distance_;  // of posed_, built at the first call
};

}  // namespace bodice::tryon
