// K-means that goes on from where it was: what a split costs is what it moves.
// Based on: Stuart P. Lloyd. Least squares quantization in PCM. 1982.
// Differs: a point is compared again only with centres that moved, unless its own centre moved away from it;
// only clusters whose points changed are averaged again. The results are the bits of the plain iteration.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <bodice/fitting/kmeans.hpp>

namespace bodice::fitting {

class Lloyd {
 public:
  /// `weights` is empty or one a point. Distances are compared in float relative to `origin`.
  Lloyd(std::span<const Vec3> points, std::span<const double> weights, const Vec3& origin);

  /// Iterates from these centres; centre k is the one of the last call, wherever it has been put. Returns the
  /// number of iterations. `centers` may only grow from call to call.
  int run(const engine::Context& context, std::vector<Vec3> centers, const KMeansOptions& options);

  const std::vector<Index>& of_point() const { return of_point_; }
  const std::vector<Vec3>& centers() const { return centers_; }
  std::vector<Vec3> take_centers() { return std::move(centers_); }
  std::vector<Index> take_of_point() { return std::move(of_point_); }

 private:
  using Flags = std::vector<std::uint8_t>;    // #centres
  using Sums = std::vector<Eigen::Vector4d>;  // #centres: weighted offset from the origin, weight
  void mark_moved();
  void assign(const engine::Context& context);
  void assign_block(std::size_t begin, std::size_t end, Flags& changed);
  void add_up(const engine::Context& context);
  double move_centers();

  std::span<const Vec3> points_;
  std::span<const double> weights_;
  Vec3 origin_;
  std::array<std::vector<float>, 3> local_;  ///< #points, relative to the origin
  std::vector<Index> of_point_;
  std::vector<float> distance_;  ///< #points, squared, to the point's own centre where it was
  std::vector<Vec3> centers_;
  std::vector<float> placed_;  ///< 3 #centres: where the distances were measured from
  Flags moved_;                ///< since then
  std::vector<Index> moved_list_, all_;
  Flags changed_;  ///< has other points than before
  Sums sums_;
  std::vector<Flags> changed_of_block_;
  std::vector<Sums> sums_of_block_;
};

}  // namespace bodice::fitting
