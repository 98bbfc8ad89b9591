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

  /// For vertices at `positions` (#V): a box around each piece, grown by kContact_m and by twice what
  /// the piece moved by since the call before, since it may move so again. Valid until the next call.
  /// Allocates nothing. O(#V).
  std::span<const geometry::Box> boxes(std::span<const geometry::Vec3> positions);

  /// What is nearer than this to the cloth matters to it, meters: contacts, fillets between ellipsoids, and
  /// what relief adds to them.
  static constexpr double kContact_m = 0.06;

 private:
  std::vector<geometry::Index> order_;                  // #V: vertices, piece by piece
  std::vector<std::size_t> first_;                      // #pieces + 1, into order_
  std::vector<geometry::Box> around_, before_, grown_;  // #pieces
};

}  // namespace bodice::tryon
