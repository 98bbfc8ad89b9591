// The peers behind one interface: the signed (or unsigned) distance of every particle to the skin.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <bench_references/subject.hpp>

namespace bench {

/// Another method that answers the same query.
struct Peer {
  std::string name;
  double build_ms = 0.0;  ///< cost in every frame if the body moves
  double bytes = 0.0;     ///< 0: not known
  /// Larger distances are not searched for.
  double reach_m = std::numeric_limits<double>::infinity();
  /// One of so many particles is measured, because more would take too long.
  std::size_t one_of = 1;
  std::function<void(const Cloud&, std::span<float> distance_m)> query;
};

/// A dense grid of signed distances, interpolated trilinearly: exact to the cell's size, rebuilt when the
/// body moves.
Peer grid_peer(const bodice::geometry::TriMesh& mesh, const bodice::geometry::MeshDistance& skin,
               double cell_m);

/// Embree's point query over the skin's triangles, within `reach_m`, unsigned; nothing if it is not
/// installed.
std::vector<Peer> embree_peers(const bodice::geometry::TriMesh& mesh, double reach_m);
std::string embree_name(double reach_m);

/// CGAL's tree of boxes over the skin's triangles, exact and unsigned; nothing if it is not installed.
std::vector<Peer> cgal_peers(const bodice::geometry::TriMesh& mesh);

/// FCL's tree of swept spheres over the skin's triangles, exact and unsigned; nothing if it is not installed.
std::vector<Peer> fcl_peers(const bodice::geometry::TriMesh& mesh);

}  // namespace bench
