// Peers that follow a body which moves: posed once a frame, then evaluated at particles.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/rig/affine.hpp>

#include <bench_references/subject.hpp>

namespace bench {

/// One frame of a skinned body.
struct MovingFrame {
  std::span<const bodice::rig::Affine> joints;    ///< #J: joint space to world
  std::span<const bodice::rig::Affine> skinning;  ///< #J: bind pose to this pose
  const bodice::geometry::TriMesh& skin;          ///< the skin in this pose
};

/// A method that answers for the pose it was brought to last.
class MovingPeer {
 public:
  virtual ~MovingPeer() = default;
  virtual std::string name() const = 0;
  /// Whether pose() reads the posed skin, so that skinning it is part of the peer's cost.
  virtual bool needs_skin() const = 0;
  /// Whether points deep inside are found to be inside.
  virtual bool knows_depth() const { return true; }
  virtual void pose(const MovingFrame& frame) = 0;
  /// The signed distance of every particle, meters; what is farther than 31 mm may only have its sign.
  virtual void query(const Cloud& cloud, std::span<float> distance_m) = 0;
  virtual double bytes() const = 0;  ///< 0: not known
};

/// A capsule a joint, around the vertices of `rest` that this joint moves most; `joint` is #V. Carried
/// rigidly.
std::unique_ptr<MovingPeer> rigid_capsules(const bodice::geometry::TriMesh& rest,
                                           std::span<const std::uint16_t> joint, std::size_t joints);

/// Embree's tree over the skin's triangles, refitted in each frame; signs by normals of faces, edges and
/// vertices. Null if it is not installed.
std::unique_ptr<MovingPeer> embree_refit(const bodice::geometry::TriMesh& rest, double reach_m);

/// A grid of signed distances, rebuilt in each frame within a band of 50 mm around the skin.
std::unique_ptr<MovingPeer> rebuilt_grid(const bodice::geometry::TriMesh& rest, double cell_m);

}  // namespace bench
