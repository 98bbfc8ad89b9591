// Patches, boxes and crumbs at random, as scans leave them: repaired, rebuilt as a closed surface, thinned,
// and read as a person's and as a thing's file.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/geometry/rebuild.hpp>
#include <bodice/geometry/thin.hpp>
#include <bodice/io/import.hpp>

#include "harness.hpp"

using namespace bodice;
using geometry::TriMesh;
using geometry::Vec3;

namespace {

constexpr std::size_t kMostTriangles = 1500;
constexpr double kCellsAcross = 24.0;
/// The first byte of inputs that are read as files as well: a skin rebuilt from a file has 215 cells, and
/// takes seconds.
constexpr std::uint8_t kRead = 7;

/// A point on a lattice with a power of two as spacing, so that faces meet exactly or not at all.
Vec3 next_point(fuzz::Bytes& in) {
  return Vec3(in.next() % 16, in.next() % 32, in.next() % 16) / 16.0;
}

/// A sheet of n by n quads; `bend` lifts its middle.
void add_patch(fuzz::Bytes& in, TriMesh& mesh) {
  const Vec3 corner = next_point(in), u = next_point(in) - corner, v = next_point(in) - corner;
  const unsigned n = 1 + in.next() % 8u, kind = in.next();
  const double bend = (kind & 3u) * 0.05;
  const auto first = static_cast<geometry::Index>(mesh.positions.size());
  for (unsigned j = 0; j <= n; ++j)
    for (unsigned i = 0; i <= n; ++i) {
      const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n;
      mesh.positions.push_back(corner + a * u + b * v +
                               Vec3(0.0, 0.0, bend * std::sin(3.1 * a) * std::sin(3.1 * b)));
    }
  for (unsigned j = 0; j < n; ++j)
    for (unsigned i = 0; i < n; ++i) {
      const geometry::Index at = first + j * (n + 1) + i;
      geometry::Triangle one = {at, at + 1, at + n + 2}, other = {at, at + n + 2, at + n + 1};
      if (kind & 4u) std::swap(one[1], one[2]);
      if (kind & 8u) std::swap(other[1], other[2]);
      mesh.triangles.push_back(one);
      if (!(kind & 16u)) mesh.triangles.push_back(other);
    }
}

/// A closed box; some of its faces may be missing or turned.
void add_box(fuzz::Bytes& in, TriMesh& mesh) {
  const Vec3 a = next_point(in), b = next_point(in), low = a.cwiseMin(b), high = a.cwiseMax(b);
  const unsigned missing = in.next(), turned = in.next();
  const auto first = static_cast<geometry::Index>(mesh.positions.size());
  for (unsigned k = 0; k < 8; ++k)
    mesh.positions.push_back(
        {k & 1u ? high.x() : low.x(), k & 2u ? high.y() : low.y(), k & 4u ? high.z() : low.z()});
  constexpr geometry::Index kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (unsigned f = 0; f < 6; ++f) {
    if ((missing & 0xC0u) && (missing >> f & 1u)) continue;
    const auto& c = kFaces[f];
    geometry::Triangle one = {first + c[0], first + c[1], first + c[2]},
                       other = {first + c[0], first + c[2], first + c[3]};
    if ((turned & 0xC0u) && (turned >> f & 1u)) std::swap(one[0], one[1]), std::swap(other[0], other[1]);
    mesh.triangles.push_back(one);
    mesh.triangles.push_back(other);
  }
}

/// Triangles between any vertices, one of which may be far off or no number.
void add_crumbs(fuzz::Bytes& in, TriMesh& mesh) {
  const unsigned kind = in.next();
  Vec3 p = next_point(in);
  if (kind % 32 == 1) p.x() = std::numeric_limits<double>::quiet_NaN();
  if (kind % 32 == 2) p *= 1e12;
  mesh.positions.push_back(p);
  const auto count = static_cast<unsigned>(mesh.positions.size());
  for (unsigned i = 0; i < kind % 5; ++i)
    mesh.triangles.push_back({in.next() * 7u % count, in.next() * 5u % count, in.next() % count});
}

TriMesh mesh_of(fuzz::Bytes& in) {
  TriMesh mesh;
  while (!in.rest().empty() && mesh.triangles.size() < kMostTriangles) {
    const unsigned kind = in.next() % 4u;
    if (kind < 2)
      add_patch(in, mesh);
    else if (kind == 2)
      add_box(in, mesh);
    else
      add_crumbs(in, mesh);
  }
  return mesh;
}

void check_indices(const TriMesh& mesh) {
  for (const Vec3& p : mesh.positions) FUZZ_CHECK(p.allFinite());
  for (const auto& t : mesh.triangles)
    for (const auto v : t) FUZZ_CHECK(v < mesh.positions.size());
}

/// A rebuilt surface is closed, lies around what it was made from, and is the same every time.
void check_rebuilt(const TriMesh& surface) {
  const geometry::Box box = geometry::bounding_box(surface.positions);
  const double size = box.size().maxCoeff(), cell = size / kCellsAcross;
  if (!(size > 0.0)) return;
  const geometry::RebuiltSurface rebuilt = geometry::rebuild({}, surface, cell);
  check_indices(rebuilt.mesh);
  if (rebuilt.mesh.empty()) return;
  FUZZ_CHECK(rebuilt.measured.size() == rebuilt.mesh.positions.size());
  FUZZ_CHECK(rebuilt.measured_share >= 0.0 && rebuilt.measured_share <= 1.0 + 1e-9);
  FUZZ_CHECK(geometry::mesh_edges(rebuilt.mesh).boundary == 0);
  for (const Vec3& p : rebuilt.mesh.positions)
    FUZZ_CHECK(((p - box.low).array() > -3.0 * cell).all() && ((box.high - p).array() > -3.0 * cell).all());
  FUZZ_CHECK(geometry::rebuild({}, surface, cell).mesh.positions == rebuilt.mesh.positions);
}

/// A thinned surface has the rims, the non-manifold edges and the topology of what it was made from.
void check_thinned(const TriMesh& surface, double edge) {
  const geometry::ThinnedSurface thinned = geometry::thin({}, surface, {.edge_m = edge, .tolerance_m = edge});
  check_indices(thinned.mesh);
  FUZZ_CHECK(thinned.kept.size() == thinned.mesh.positions.size());
  for (const geometry::Index v : thinned.vertex_of_input) FUZZ_CHECK(v < thinned.kept.size());
  const geometry::MeshEdges before = geometry::mesh_edges(surface),
                            after = geometry::mesh_edges(thinned.mesh);
  FUZZ_CHECK(before.boundary == after.boundary);
  FUZZ_CHECK(before.non_manifold == after.non_manifold);
  FUZZ_CHECK(geometry::euler_characteristic(surface, before) ==
             geometry::euler_characteristic(thinned.mesh, after));
  check_indices(geometry::thin_noisy({}, surface, edge, {.edge_m = edge}).mesh);
}

std::vector<std::uint8_t> as_stl(const TriMesh& mesh) {
  std::vector<std::uint8_t> bytes(80 + 4 + 50 * mesh.triangles.size());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f p = mesh.corner(t, k).cast<float>();
      std::memcpy(bytes.data() + 84 + 50 * t + 12 + 12 * static_cast<std::size_t>(k), p.data(), 12);
    }
  return bytes;
}

}  // namespace

FUZZ_TARGET(repair) {
  fuzz::Bytes in(data, size);
  const unsigned kind = in.next();
  const bool is_read = kind == kRead;
  const TriMesh mesh = mesh_of(in);
  const auto repaired = geometry::repair({}, mesh);
  fuzz::check_reported(repaired);
  if (!repaired.ok()) return 0;
  check_indices(repaired->mesh);
  check_rebuilt(repaired->mesh);
  check_thinned(repaired->mesh,
                kind / 512.0 * geometry::bounding_box(repaired->mesh.positions).size().maxCoeff());
  if (!is_read) return 0;
  const fuzz::TemporaryFile file(".stl", as_stl(mesh));
  for (const io::Shape shape : {io::Shape::kPerson, io::Shape::kAny}) {
    const auto read = io::import_body({}, file.path(), {.shape = shape, .unit = io::Unit::kMeter});
    fuzz::check_reported(read);
    if (read.ok()) check_indices(read->skin);
  }
  return 0;
}
