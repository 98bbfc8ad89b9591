// The joints of a pose: checked, mended, and turned into skinning matrices.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <bodice/proxy/binding.hpp>

namespace bodice::inline v0_1::binding {

/// Why a joint's matrix is refused.
struct Refusal {
  std::size_t joint = 0;
  std::string_view reason;
};

/// The joints of one binding, and the skinning matrices of the last pose that was taken.
class JointMotion {
 public:
  explicit JointMotion(const proxy::Binding& binding);

  /// Takes joint space to world of each joint. Joints that move no skin are not looked at. On refusal the
  /// matrices are as before. Allocates nothing.
  std::optional<Refusal> take(std::span<const proxy::JointMatrix> world);

  /// #J: bind space to world, a rotation times a scale for ordinary rigs.
  std::span<const proxy::JointMatrix> skinning() const { return skinning_; }
  /// Geometric mean of the scales of the joints that move skin.
  double scale() const { return scale_; }

 private:
  std::vector<std::uint8_t> moves_skin_;      ///< #J
  std::vector<proxy::JointMatrix> to_joint_;  ///< #J: inverse bind matrices
  std::vector<Eigen::Vector3d> head_;         ///< #J: the joint's origin in the bind pose
  std::vector<proxy::JointMatrix> skinning_, trial_;
  double scale_ = 1.0;
};

}  // namespace bodice::binding
