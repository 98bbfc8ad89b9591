#include "garment/topology.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace bodice::inline v0_1::cloth {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

// A quad counts as a rectangle up to this cosine of the angle opposite its diagonal (75 to 105 degrees).
// Meshes of garments mostly consist of quads along warp and weft that are cut in two.
constexpr double kRectangleCosine = 0.26;

struct HalfEdge {
  Index a, b, opposite;
  std::size_t triangle;
};

std::vector<HalfEdge> sorted_half_edges(const TriMesh& mesh) {
  std::vector<HalfEdge> half;
  half.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& tri = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index u = tri[k], v = tri[(k + 1) % 3];
      half.push_back({std::min(u, v), std::max(u, v), tri[(k + 2) % 3], t});
    }
  }
  std::sort(half.begin(), half.end(), [](const HalfEdge& l, const HalfEdge& r) {
    return std::tie(l.a, l.b, l.triangle) < std::tie(r.a, r.b, r.triangle);
  });
  return half;
}

bool right_angle_opposite(const TriMesh& mesh, const HalfEdge& h) {
  const Vec3 u = mesh.positions[h.a] - mesh.positions[h.opposite];
  const Vec3 v = mesh.positions[h.b] - mesh.positions[h.opposite];
  return std::abs(u.dot(v)) < kRectangleCosine * u.norm() * v.norm();
}

}  // namespace

Topology find_topology(const TriMesh& mesh) {
  const std::vector<HalfEdge> half = sorted_half_edges(mesh);
  Topology out;
  for (std::size_t first = 0, next = 0; first < half.size(); first = next) {
    Edge edge{half[first].a, half[first].b, 0.0, true};
    for (next = first; next < half.size() && half[next].a == edge.a && half[next].b == edge.b; ++next) {
      edge.area_m2 += 0.5 * geometry::area_vector(mesh, half[next].triangle).norm();
      edge.diagonal = edge.diagonal && right_angle_opposite(mesh, half[next]);
      if (next > first) out.hinges.push_back({edge.a, edge.b, half[next - 1].opposite, half[next].opposite});
    }
    edge.diagonal = edge.diagonal && next - first == 2;
    out.edges.push_back(edge);
  }
  return out;
}

Ring make_ring(const TriMesh& mesh, const Topology& topology) {
  Ring ring;
  ring.begin.assign(mesh.positions.size() + 1, 0);
  for (const Edge& e : topology.edges) ++ring.begin[e.a + 1], ++ring.begin[e.b + 1];
  for (std::size_t i = 1; i < ring.begin.size(); ++i) ring.begin[i] += ring.begin[i - 1];
  ring.neighbor.resize(2 * topology.edges.size());
  std::vector<Index> next(ring.begin.begin(), ring.begin.end() - 1);
  for (const Edge& e : topology.edges) ring.neighbor[next[e.a]++] = e.b, ring.neighbor[next[e.b]++] = e.a;
  return ring;
}

}  // namespace bodice::cloth
