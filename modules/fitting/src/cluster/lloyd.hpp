// K-means with a state that outlives a call, so that a split of one cluster costs only what it changes.
// Based on: Stuart P. Lloyd. Least squares quantization in PCM. 1982.
// Differs: neighboring points form chunks, each with a ball that holds it. The ball bounds which centers can
// be nearest to a point of the chunk; only these are compared. A chunk is skipped if its own centers did not
// move and no other center came near. A chunk keeps the sums of its points by center until one of its points
// changes center.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/fitting/kmeans.hpp>

namespace bodice::inline v0_1::fitting {

/// K-means with a state.
class Lloyd {
 public:
  /// `weights` is empty or has one for each point. Distances are compared in float relative to `origin`.
  Lloyd(std::span<const Vec3> points, std::span<const double> weights, const Vec3& origin);

  /// Iterates from these centers and returns the number of iterations. Center k continues center k of the
  /// last call, even if it was moved; the number of centers may only grow from call to call.
  int run(const engine::Context& context, std::vector<Vec3> centers, const KMeansOptions& options);

  /// #points: the center of each.
  std::vector<Index> of_point() const;
  const std::vector<Vec3>& centers() const { return centers_; }
  std::vector<Vec3> take_centers() { return std::move(centers_); }

 private:
  using Sum = Eigen::Vector4d;  // the sum of weighted offsets from the origin, and the sum of weights
  /// The points of a chunk that have the same center.
  struct Share {
    Index center;
    Sum sum;
  };
  /// Neighboring points.
  struct Chunk {
    std::array<float, 3> middle;
    float radius = 0.0f;        ///< radius of a ball about the middle that holds the points
    float farthest = 0.0f;      ///< bound on a point's distance to its center when it was assigned
    std::vector<Share> shares;  ///< empty: the points have no center yet
  };
  struct Scratch {
    std::vector<float> from_middle;
    std::vector<Index> candidates;
  };
  void bound_chunk(std::size_t chunk);
  void mark_moved();
  void assign(const engine::Context& context);
  bool choose_candidates(const Chunk& chunk, Scratch& scratch) const;
  void assign_chunk(std::size_t chunk, Scratch& scratch, std::vector<std::uint8_t>& changed);
  void share_out(std::size_t chunk);
  double move_centers();

  Vec3 origin_;
  std::vector<Index> order_;                 ///< #points: the given points' indices in spatial order
  std::array<std::vector<float>, 3> local_;  ///< #points in spatial order, relative to the origin
  std::vector<Sum> weighted_;                ///< #points in spatial order: each point's own sum
  std::vector<Index> of_point_;              ///< #points in spatial order: the center of each
  std::vector<Chunk> chunks_;
  std::vector<Vec3> centers_;
  std::vector<float> placed_;          ///< 3 #centers: x, y, z relative to the origin
  std::vector<std::uint8_t> moved_;    ///< #centers: whether it moved since the points were assigned
  std::vector<Index> moved_list_;      ///< the centers that moved
  std::vector<std::uint8_t> changed_;  ///< #centers: whether its set of points changed
  std::vector<std::vector<std::uint8_t>> changed_of_block_;
};

}  // namespace bodice::fitting
