// The rivals, each behind the same question: the signed (or unsigned) distance of every particle to the skin.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <bench_references/subject.hpp>

namespace bench {

struct Peer {
  std::string name;
  double build_ms = 0.0;  ///< what a body that moves pays every frame
  double bytes = 0.0;     ///< 0: not known
  /// No distance beyond is looked for.
  double reach_m = std::numeric_limits<double>::infinity();
  /// One of so many particles is asked about; more would take too long.
  std::size_t one_of = 1;
  std::function<void(const Cloud&, std::span<float> distance_m)> query;
};

/// A dense grid of signed distances, trilinear: exact to the cell's size, rebuilt when the body moves.
Peer grid_peer(const bodice::geometry::TriMesh& mesh, const bodice::geometry::MeshDistance& skin,
               double cell_m);

/// Embree's point query over the skin's triangles, within `reach_m`, unsigned; nothing where it is missing.
std::vector<Peer> embree_peers(const bodice::geometry::TriMesh& mesh, double reach_m);
std::string embree_name(double reach_m);

/// CGAL's tree of boxes over the skin's triangles, exact and unsigned; nothing where it is missing.
std::vector<Peer> cgal_peers(const bodice::geometry::TriMesh& mesh);

/// FCL's tree of swept spheres over the skin's triangles, exact and unsigned; nothing where it is missing.
std::vector<Peer> fcl_peers(const bodice::geometry::TriMesh& mesh);

}  // namespace bench
