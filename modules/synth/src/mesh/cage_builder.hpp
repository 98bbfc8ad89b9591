// Tubes and lids: the two moves that build a cage.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesh/cage.hpp"

namespace bodice::synth {

/// Vertices of the cage, in order around a tube.
using Loop = std::vector<int>;

class CageBuilder {
 public:
  int add(const Vec3& p) {
    cage_.positions.push_back(p);
    return static_cast<int>(cage_.positions.size()) - 1;
  }
  Vec3& position(int vertex) { return cage_.positions[vertex]; }

  void quad(int a, int b, int c, int d, Region region) {
    cage_.quads.push_back({a, b, c, d});
    cage_.quad_region.push_back(region);
  }

  /// Quads between two loops of the same length, except those whose first edge number is in `open`.
  void band(const Loop& from, const Loop& to, Region region, std::span<const int> open = {});

  /// Adds a ring of new vertices and joins it to the loop.
  Loop extrude(const Loop& from, const std::function<Vec3(int)>& place, Region region,
               std::span<const int> open = {});

  /// Closes a loop with a grid of `columns` x `rows` quads; the loop runs first along the columns. Inner
  /// vertices start on straight lines between the sides, moved by `bulge`.
  void lid(const Loop& loop, int columns, int rows, const Vec3& bulge, Region region);

  /// These vertices are the floor of the trunk between the legs.
  void mark_crotch(int vertex) { crotch_.push_back(vertex); }

  /// Orients the quads outward and says which skin each vertex lies on.
  Cage finish();

 private:
  void orient();
  void assign_regions();

  Cage cage_;
  std::vector<int> crotch_;
};

/// Which skin the meeting place of two regions lies on.
Region meeting(Region a, Region b);

}  // namespace bodice::synth
