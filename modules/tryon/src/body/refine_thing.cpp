#include "body/refine_thing.hpp"

#include <array>
#include <cmath>

#include <bodice/geometry/mesh_edges.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::Triangle;
using geometry::TriMesh;

/// The longest edge that stays is the square root of the area over this: 2 cm for a chair.
constexpr double kAcross = 60.0;
/// A surface with more vertices is fine enough, however long some of its edges are.
constexpr std::size_t kFineVertices = 100'000;

/// The middle of each edge that is longer than `limit`, added to the mesh; kNoIndex for others.
std::vector<Index> add_middles(const geometry::MeshEdges& edges, double limit, TriMesh& mesh) {
  std::vector<Index> middle(edges.ends.size(), kNoIndex);
  for (std::size_t e = 0; e < middle.size(); ++e) {
    const geometry::Vec3 a = mesh.positions[edges.ends[e][0]], b = mesh.positions[edges.ends[e][1]];
    if (!((a - b).norm() > limit)) continue;
    middle[e] = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back(0.5 * (a + b));
  }
  return middle;
}

/// Adds the triangles into which a triangle is split. `m` has the middles of its edges 01, 12 and 20.
void split(const Triangle& t, const std::array<Index, 3>& m, std::vector<Triangle>& out) {
  int count = 0, first = 0;  // the edge after one that stays, or the only one that is split
  for (int k = 0; k < 3; ++k) {
    if (m[k] == kNoIndex) continue;
    ++count;
    if (count == 1 || m[(k + 2) % 3] == kNoIndex) first = k;
  }
  const auto corner = [&](int k) { return t[(first + k) % 3]; };
  const auto middle = [&](int k) { return m[(first + k) % 3]; };
  if (count == 0) out.push_back(t);
  if (count == 1) {
    out.push_back({corner(0), middle(0), corner(2)});
    out.push_back({middle(0), corner(1), corner(2)});
  }
  if (count == 2) {
    out.push_back({middle(0), corner(1), middle(1)});
    out.push_back({corner(0), middle(0), middle(1)});
    out.push_back({corner(0), middle(1), corner(2)});
  }
  if (count == 3) {
    for (int k = 0; k < 3; ++k) out.push_back({corner(k), middle(k), middle(k + 2)});
    out.push_back({middle(0), middle(1), middle(2)});
  }
}

}  // namespace

void refine_thing(io::ImportedMesh& thing) {
  TriMesh& mesh = thing.skin;
  const double limit = std::sqrt(geometry::surface_area(mesh)) / kAcross;
  if (!(limit > 0.0)) return;
  for (std::size_t before = 0; before != mesh.positions.size() && mesh.positions.size() < kFineVertices;) {
    before = mesh.positions.size();
    const geometry::MeshEdges edges = geometry::mesh_edges(mesh);
    const std::vector<Index> middle = add_middles(edges, limit, mesh);
    std::vector<Triangle> triangles;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      const std::array<Index, 3>& of = edges.of_triangle[f];
      split(mesh.triangles[f], {middle[of[0]], middle[of[1]], middle[of[2]]}, triangles);
    }
    mesh.triangles = std::move(triangles);
  }
  if (!thing.made_up.empty()) thing.made_up.resize(mesh.positions.size(), 0);
}

}  // namespace bodice::tryon
