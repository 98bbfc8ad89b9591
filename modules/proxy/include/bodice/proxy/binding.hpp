// What carries a proxy along with the joints of a rig: constants that binding computes once, and posing
// reads.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::proxy {

/// x -> A.leftCols<3>() x + A.col(3). The same type as rig::Affine.
using JointMatrix = Eigen::Matrix<double, 3, 4, Eigen::DontAlign>;

/// One joint's share of an ellipsoid's affine map: the map is the sum over its terms of T * matrix, where T
/// is the joint's skinning matrix with (0, 0, 0, 1) below it.
struct CarryTerm {
  std::uint16_t joint = 0;
  std::array<double, 16> matrix = {};  ///< 4 x 4, by columns
};

/// Nodes that one vector instruction handles.
inline constexpr int kBundle = 16;
/// Tables with more nodes a side are carried, but do not follow the skin: their texels need 16 bits.
inline constexpr int kMostBoundNodes = 255;

/// Sixteen texels of one table and the skin points at their surface, at rest. Lengths are in units of the
/// table's step, in the frame of the ellipsoid's center with the skin's axes.
struct SkinBundle {
  std::array<std::uint16_t, kBundle> texel = {};                   ///< in the table; the last ones may repeat
  std::array<std::array<std::int16_t, kBundle>, 3> position = {};  ///< of the skin point less the center
  /// Octahedral map of the unit direction of the skin point's closest point on the ellipsoid, in 1/32767.
  std::array<std::array<std::int16_t, kBundle>, 2> direction = {};
  std::array<std::int16_t, kBundle> height = {};  ///< its signed distance to the ellipsoid
};

/// How much one joint moves the skin points of a bundle.
struct SkinEntry {
  std::uint16_t term = 0;                          ///< among the terms of the ellipsoid
  std::array<std::uint16_t, kBundle> weight = {};  ///< in 1/65535
};

/// Plain data, checked by BodyProxy::make(). E ellipsoids, J joints, X texels, B bundles.
struct Binding {
  std::vector<std::string> joint_names;   ///< #J
  std::vector<JointMatrix> bind;          ///< #J: joint space to skin space in the bind pose
  std::vector<std::uint32_t> first_term;  ///< #E + 1
  std::vector<CarryTerm> terms;
  float burial_step_m = 0.0f;               ///< of Binding::burial
  std::vector<std::uint8_t> burial;         ///< #X: depth of each texel's surface point in other ellipsoids
  std::vector<float> step_m;                ///< #E: unit of the lengths of its bundles
  std::vector<std::uint32_t> first_bundle;  ///< #E + 1; an ellipsoid without bundles keeps its table
  std::vector<SkinBundle> bundles;          ///< #B
  std::vector<std::uint32_t> first_entry;   ///< #B + 1
  std::vector<SkinEntry> entries;
  std::vector<std::uint32_t> first_follower;  ///< #E: into followers, of tables with bundles
  std::vector<std::uint16_t> followers;  ///< for each of their texels, the skin node that it changes with

  /// Bytes in memory.
  std::size_t bytes() const;
};

}  // namespace bodice::proxy
