// K-means whose state outlives a call, so that a split of one cluster costs what it changes.
// Based on: Stuart P. Lloyd. Least squares quantization in PCM. 1982.
// Differs: points are taken in chunks of neighbors, each with a ball that holds it. A chunk looks only at
// the centers that its ball lets be nearest to a point of it, and at none if neither its own centers moved
// nor any other came near. It keeps the sums of its points by center until one of them goes elsewhere.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/fitting/kmeans.hpp>

namespace bodice::fitting {

class Lloyd {
 public:
  /// `weights` is empty or one a point. Distances are compared in float relative to `origin`.
  Lloyd(std::span<const Vec3> points, std::span<const double> weights, const Vec3& origin);

  /// Iterates from these centers; center k is the one of the last call, wherever it has been put. Returns the
  /// number of iterations. `centers` may only grow from call to call.
  int run(const engine::Context& context, std::vector<Vec3> centers, const KMeansOptions& options);

  /// #points, the center of each.
  std::vector<Index> of_point() const;
  const std::vector<Vec3>& centers() const { return centers_; }
  std::vector<Vec3> take_centers() { return std::move(centers_); }

 private:
  using Sum = Eigen::Vector4d;  // weighted offsets from the origin, weight
  /// Points of a chunk that have the same center.
  struct Share {
    Index center;
    Sum sum;
  };
  /// Neighbors among the points.
  struct Chunk {
    std::array<float, 3> middle;
    float radius = 0.0f;        ///< of a ball about the middle that holds them
    float farthest = 0.0f;      ///< from its own center where it was, at most
    std::vector<Share> shares;  ///< empty: no center yet
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
  std::vector<Index> order_;                 ///< #points: of those that came in
  std::array<std::vector<float>, 3> local_;  ///< #points, relative to the origin
  std::vector<Sum> weighted_;                ///< #points, each alone
  std::vector<Index> of_point_;
  std::vector<Chunk> chunks_;
  std::vector<Vec3> centers_;
  std::vector<float> placed_;        ///< 3 #centers, relative to the origin
  std::vector<std::uint8_t> moved_;  ///< #centers: since the points were assigned
  std::vector<Index> moved_list_;
  std::vector<std::uint8_t> changed_;  ///< #centers: has other points than before
  std::vector<std::vector<std::uint8_t>> changed_of_block_;
};

}  // namespace bodice::fitting
