// Where garments may touch a body in the next frame: boxes around pieces of cloth.
#pragma once

#include <span>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::tryon {

/// Pieces of garments, each of some neighboring vertices, and their boxes. Not thread-safe.
class GarmentReach {
 public:
  /// Divides vertices into pieces by where they are now. Allocates. O(#V log #V).
  explicit GarmentReach(std::span<const geometry::Vec3> positions);

  /// The box of each piece for vertices at `positions` (#V). It is enlarged by kContact_m, and by twice the
  /// piece's motion since the last call, because the piece may move as far again. Valid until the next call.
  /// Allocates nothing. O(#V).
  std::span<const geometry::Box> boxes(std::span<const geometry::Vec3> positions);

  /// The distance within which the body matters to cloth, meters. It covers contacts, fillets between
  /// ellipsoids, and the height of relief.
  static constexpr double kContact_m = 0.06;

 private:
  std::vector<geometry::Index> order_;                  // #V: vertices, piece by piece
  std::vector<std::size_t> first_;                      // #pieces + 1, into order_
  std::vector<geometry::Box> around_, before_, grown_;  // #pieces
};

}  // namespace bodice::tryon
