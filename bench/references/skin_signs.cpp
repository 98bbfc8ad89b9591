#include <bench_references/skin_signs.hpp>

#include <algorithm>
#include <cmath>

namespace bench {

using bodice::geometry::Index;
using bodice::geometry::TriangleFeature;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

void SkinSigns::update(const TriMesh& mesh) {
  face_.resize(mesh.triangles.size());
  vertex_.assign(mesh.positions.size(), Vec3::Zero());
  for (std::size_t t = 0; t < face_.size(); ++t) {
    face_[t] = bodice::geometry::area_vector(mesh, t).stableNormalized();
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
      const Vec3 b = mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k);
      const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
      if (!(lengths > 0.0)) continue;
      const double angle = std::acos(std::clamp(a.dot(b) / lengths, -1.0, 1.0));
      vertex_[mesh.triangles[t][static_cast<std::size_t>(k)]] += angle * face_[t];
    }
  }
}

bool SkinSigns::is_inside(const TriMesh& mesh, Index t, const bodice::geometry::TrianglePoint& closest,
                          const Vec3& point) const {
  const auto across = [&](int k) -> Vec3 {
    const Index other = edges_.across(t, k);
    return other == bodice::geometry::kNoIndex ? face_[t] : Vec3(face_[t] + face_[other]);
  };
  const Vec3 normal = [&]() -> Vec3 {
    switch (closest.feature) {
      case TriangleFeature::kFace:
        return face_[t];
      case TriangleFeature::kEdge01:
        return across(0);
      case TriangleFeature::kEdge12:
        return across(1);
      case TriangleFeature::kEdge20:
        return across(2);
      case TriangleFeature::kVertex0:
        return vertex_[mesh.triangles[t][0]];
      case TriangleFeature::kVertex1:
        return vertex_[mesh.triangles[t][1]];
      case TriangleFeature::kVertex2:
        return vertex_[mesh.triangles[t][2]];
    }
    return face_[t];
  }();
  return normal.dot(point - closest.point) < 0.0;
}

double SkinSigns::bytes() const {
  return static_cast<double>(sizeof(Vec3) * (face_.size() + vertex_.size()) +
                             sizeof(Index) * (edges_.of_triangle.size() * 3 + edges_.triangles.size() * 2));
}

}  // namespace bench
