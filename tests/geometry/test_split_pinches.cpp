#include <doctest/doctest.h>

#include <map>
#include <set>

#include <bodice/geometry/split_pinches.hpp>

using namespace bodice::geometry;

namespace {

/// A box with outward triangles, its vertices appended to a mesh; equal corners share a vertex.
void add_box(const Vec3& low, std::map<std::array<double, 3>, Index>& index, TriMesh& mesh) {
  const auto vertex = [&](int corner) {
    const Vec3 p = low + Vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const auto [found, fresh] =
        index.emplace(std::array{p.x(), p.y(), p.z()}, static_cast<Index>(mesh.positions.size()));
    if (fresh) mesh.positions.push_back(p);
    return found->second;
  };
  constexpr int kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : kQuads) {
    mesh.triangles.push_back({vertex(q[0]), vertex(q[1]), vertex(q[2])});
    mesh.triangles.push_back({vertex(q[0]), vertex(q[2]), vertex(q[3])});
  }
}

/// Whether each directed edge occurs once, and its reverse as well.
bool is_edge_manifold(const TriMesh& mesh) {
  std::set<std::pair<Index, Index>> edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (!edges.emplace(t[k], t[(k + 1) % 3]).second) return false;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) return false;
  return true;
}

}  // namespace

TEST_CASE("boxes that touch along edges of a checkerboard become edge-manifold and keep their volume") {
  TriMesh mesh;
  std::map<std::array<double, 3>, Index> index;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z)
        if ((x + y + z) % 2 == 0) add_box(Vec3(x, y, z), index, mesh);
  REQUIRE_FALSE(is_edge_manifold(mesh));
  const TriMesh before = mesh;
  const std::vector<Index> original = split_pinches(mesh, 0.01);
  CHECK(is_edge_manifold(mesh));
  CHECK(mesh.positions.size() == before.positions.size() + original.size());
  CHECK(signed_volume(mesh) == doctest::Approx(signed_volume(before)).epsilon(0.05));
  std::set<std::array<double, 3>> distinct;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    CHECK(distinct.insert({p.x(), p.y(), p.z()}).second);
    const Index from =
        v < before.positions.size() ? static_cast<Index>(v) : original[v - before.positions.size()];
    CHECK((p - before.positions[from]).norm() <= 0.01 * 1.5);
  }
}

TEST_CASE("a mesh that touches itself nowhere keeps its bits") {
  TriMesh mesh;
  std::map<std::array<double, 3>, Index> index;
  add_box(Vec3::Zero(), index, mesh);
  add_box(Vec3(3, 0, 0), index, mesh);
  const TriMesh before = mesh;
  CHECK(split_pinches(mesh, 0.01).empty());
  CHECK(mesh.positions == before.positions);
  CHECK(mesh.triangles == before.triangles);
}
