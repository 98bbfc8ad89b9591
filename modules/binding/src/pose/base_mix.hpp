// How much of each base pose the tables of a pose take.
//
// For ellipsoid k and base b, chord c_kb is the largest of
//   |R_j0^T R_j - B_j0^T B_j| / sqrt(2)
// over the joints j that move the ellipsoid's skin, where j0 is the one that moves most of it, and R and B
// are the rotations of the skinning matrices in the pose and in the base pose: about the angle by which
// joints are turned otherwise. Rest is a base as well. The shares are (Shepard 1968)
//   (1)  share_kb = v_kb / sum_b v_kb,   v_kb = 1 / (c_kb^2 + c0^2)^2
// smooth in the joints, near one around a base, and half between two. While a base becomes present, shares
// with it and without it are mixed.
// Based on: Donald Shepard. A two-dimensional interpolation function for irregularly-spaced data. 1968;
// J. P. Lewis, Matt Cordner, Nickson Fong. Pose Space Deformation. 2000 (corrections that belong to poses).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <bodice/proxy/base_pose.hpp>

namespace bodice::inline v0_1::binding {

/// The base poses of one proxy, and their shares in one pose.
class BaseMix {
 public:
  /// Begins without base poses.
  explicit BaseMix(const proxy::BodyProxy& bound);

  /// Adds a base pose of the proxy. It becomes present over `poses` calls of find(). With more than
  /// kMostPassing of those that are not to stay, the least used of these goes. Allocates.
  void add(std::shared_ptr<const proxy::BasePose> base, int poses, bool stays);

  /// Finds the shares for skinning matrices of #J joints, and makes bases that were added more present.
  /// Allocates nothing.
  void find(std::span<const proxy::JointMatrix> skinning);

  /// The largest chord c_kb of some ellipsoid to the base that is nearest to it, rest included, for joints in
  /// the world. Allocates nothing.
  double departure(std::span<const proxy::JointMatrix> world);

  std::size_t size() const { return bases_.size(); }
  const proxy::BasePose& base(std::size_t b) const { return *bases_[b].pose; }
  /// The share of a base pose in the tables of an ellipsoid; shares of all and share_of_rest() sum to 1.
  float share(std::size_t ellipsoid, std::size_t b) const {
    return shares_[ellipsoid * (bases_.size() + 1) + b + 1];
  }
  float share_of_rest(std::size_t ellipsoid) const { return shares_[ellipsoid * (bases_.size() + 1)]; }

  static constexpr std::size_t kMostPassing = 6;

 private:
  struct Base {
    std::shared_ptr<const proxy::BasePose> pose;
    std::vector<Eigen::Matrix3f> rotation;  ///< #J: of the skinning matrices
    double presence = 1.0, more_each_pose = 0.0;
    bool stays = false;
  };

  /// Rotations of the skinning matrices of joints in the world.
  void take(std::span<const proxy::JointMatrix> world, std::span<Eigen::Matrix3f> rotation) const;
  /// Adds `weight` times the shares of an ellipsoid: of all bases, or of those that are wholly present.
  void add_shares(std::size_t k, bool all, float weight);
  /// The base among those that pass which the last pose used least.
  std::size_t least_used() const;

  proxy::BodyProxy bound_;
  std::vector<Base> bases_;
  std::vector<Eigen::Matrix3f> to_joint_;           // #J: inverse of the bind pose, linear parts
  std::vector<Eigen::Matrix3f> rotation_, other_;   // #J: of the pose, of another one
  std::vector<std::vector<std::uint16_t>> joints_;  // #E: those that move much of an ellipsoid's skin
  std::vector<double> value_;                       // 1 + #bases, scratch
  std::vector<float> shares_;                       // #E x (1 + #bases), rest first
};

}  // namespace bodice::binding
