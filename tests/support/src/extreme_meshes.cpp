#include <bodice_test/extremes.hpp>
#include <bodice_test/shapes.hpp>

#include "not_finite.hpp"

namespace bodice_test {
namespace {

using bodice::geometry::Index;

TriMesh ball() {
  return icosphere(1.0, 2);
}

/// The mesh with one more vertex, and a triangle from it to the first two vertices.
TriMesh with_spike(TriMesh mesh, const Vec3& tip) {
  mesh.positions.push_back(tip);
  mesh.triangles.push_back({0, 1, static_cast<Index>(mesh.positions.size() - 1)});
  return mesh;
}

TriMesh with_vertex(TriMesh mesh, const Vec3& vertex) {
  mesh.positions.push_back(vertex);
  return mesh;
}

TriMesh with_first_twice(TriMesh mesh) {
  const bodice::geometry::Triangle first = mesh.triangles.front();
  mesh.triangles.push_back(first);
  mesh.triangles.push_back({first[1], first[0], first[2]});
  return mesh;
}

TriMesh reversed(TriMesh mesh, std::size_t every) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += every)
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return mesh;
}

TriMesh without_every(TriMesh mesh, std::size_t every) {
  std::vector<bodice::geometry::Triangle> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (t % every != 0) kept.push_back(mesh.triangles[t]);
  mesh.triangles = kept;
  return mesh;
}

TriMesh stretched(TriMesh mesh, const Vec3& factors) {
  for (Vec3& p : mesh.positions) p = p.cwiseProduct(factors);
  return mesh;
}

std::vector<MeshCase> make_meshes() {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const Vec3 far(6e3, -6.4e3, 4.8e3);
  return {
      {"empty", {}, false},
      {"vertices only", {{a, b, c}, {}}, false},
      {"one triangle", {{a, b, c}, {{0, 1, 2}}}, true},
      {"one point as a triangle", {{a, b, c}, {{0, 0, 0}}}, false},
      {"collinear triangle", {{a, b, 2.0 * b}, {{0, 1, 2}}}, false},
      {"all triangles collinear", {{a, b, 2.0 * b, 3.0 * b}, {{0, 1, 2}, {1, 2, 3}}}, false},
      {"index out of range", {{a, b, c}, {{0, 1, 7}}}, false},
      {"one of two triangles out of range", {{a, b, c}, {{0, 1, 2}, {1, 2, 4000000000u}}}, true},
      {"all vertices at one point", {{b, b, b, b}, {{0, 1, 2}, {1, 2, 3}}}, false},
      {"all NaN", {{Vec3::Constant(kNan), Vec3::Constant(kNan), Vec3::Constant(kNan)}, {{0, 1, 2}}}, false},
      {"flat sheet", sheet(1.0, 1.0, 4, 4), true},
      {"sphere", ball(), true},
      {"sphere soup", soup(ball()), true},
      {"sphere inside out", reversed(ball(), 1), true},
      {"sphere, every third reversed", reversed(ball(), 3), true},
      {"sphere with holes", without_every(ball(), 7), true},
      {"sphere, one triangle twice and once reversed", with_first_twice(ball()), true},
      {"sphere with a fin", with_spike(ball(), {0.0, 3.0, 0.0}), true},
      {"sphere with a NaN spike", with_spike(ball(), {0.0, kNan, 0.0}), true},
      {"sphere with an infinite spike", with_spike(ball(), {kInf, 0.0, 0.0}), true},
      {"sphere with an absurd spike", with_spike(ball(), {1e200, 0.0, 0.0}), true},
      {"sphere with an unused NaN vertex", with_vertex(ball(), Vec3::Constant(kNan)), true},
      {"sphere with a stray vertex", with_vertex(ball(), {0.0, 3.0, 0.0}), true},
      {"sphere with a stray sphere 100 km away", joined(ball(), icosphere(1.0, 0, {1e5, 0.0, 0.0})), true},
      {"two overlapping spheres", joined(ball(), icosphere(1.0, 2, {0.8, 0.1, 0.0})), true},
      {"needle 1e6", stretched(ball(), {1e-6, 1.0, 1e-6}), true},
      {"disk 1e6", stretched(ball(), {1.0, 1e-6, 1.0}), true},
      {"torus", torus(1.0, 0.3, 24, 12), true},
      {"sphere at scale 1e-6", moved(ball(), 1e-6, Vec3::Zero()), true},
      {"sphere at scale 1e6", moved(ball(), 1e6, Vec3::Zero()), true},
      {"sphere 10 km away", moved(ball(), 1.0, far), true},
      {"millimeter sphere 10 km away", moved(ball(), 1e-3, far), true},
  };
}

}  // namespace

const std::vector<MeshCase>& extreme_meshes() {
  static const std::vector<MeshCase> rows = make_meshes();
  return rows;
}

}  // namespace bodice_test
