// Tubes and lids, from which a cage is built.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesh/cage.hpp"

namespace bodice::inline v0_1::synth {

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

  /// Adds quads between two loops of the same length, except between the edges with numbers in `open`.
  void band(const Loop& from, const Loop& to, Region region, std::span<const int> open = {});

  /// Adds a ring of new vertices and joins it to the loop.
  Loop extrude(const Loop& from, const std::function<Vec3(int)>& position, Region region,
               std::span<const int> open = {});

  /// Closes a loop with a grid of `columns` x `rows` quads; the loop runs first along the columns. Inner
  /// vertices start on straight lines between the sides, moved by `bulge`.
  void lid(const Loop& loop, int columns, int rows, const Vec3& bulge, Region region);

  /// Marks a vertex of the floor of the trunk between the legs.
  void mark_crotch(int vertex) { crotch_.push_back(vertex); }

  /// Orients the quads outward and assigns each vertex to a region of the skin.
  Cage finish();

 private:
  void orient();
  void assign_regions();

  Cage cage_;
  std::vector<int> crotch_;
};

/// The region of a vertex between two regions.
Region shared_region(Region a, Region b);

}  // namespace bodice::synth
