// Based on: C. Bradford Barber, David P. Dobkin, Hannu Huhdanpaa. The Quickhull Algorithm for Convex Hulls.
// 1996. - a face grows to its farthest point
// Differs: points are few, so that each step looks at all of them.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <bodice/colliders/convex_pieces.hpp>

namespace bodice::inline v0_1::colliders {
namespace {

using geometry::Index;
using geometry::Triangle;

/// What is flat: thinner than this share of the longest distance between points.
constexpr double kFlat = 1e-9;

class Hull {
 public:
  explicit Hull(std::span<const Vec3> points) : points_(points) {}

  /// Returns false where the points lie in a plane.
  bool run() {
    if (!start()) return false;
    while (const auto next = farthest()) grow(next->face, next->point);
    return true;
  }

  geometry::TriMesh mesh() const {
    geometry::TriMesh mesh;
    std::map<Index, Index> number;
    for (const Triangle& face : faces_) {
      Triangle corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [found, fresh] = number.emplace(face[k], static_cast<Index>(mesh.positions.size()));
        if (fresh) mesh.positions.push_back(points_[face[k]]);
        corners[k] = found->second;
      }
      mesh.triangles.push_back(corners);
    }
    return mesh;
  }

 private:
  struct Outside {
    std::size_t face;
    Index point;
  };

  Vec3 normal(const Triangle& f) const {
    return (points_[f[1]] - points_[f[0]]).cross(points_[f[2]] - points_[f[0]]).normalized();
  }
  double height(const Triangle& face, Index point) const {
    return normal(face).dot(points_[point] - points_[face[0]]);
  }

  template <class Measure>
  Index most(Measure measure) const {
    Index best = 0;
    for (Index i = 1; i < points_.size(); ++i)
      if (measure(points_[i]) > measure(points_[best])) best = i;
    return best;
  }

  /// A tetrahedron of points far from each other.
  bool start() {
    if (points_.size() < 4) return false;
    const Index a = most([](const Vec3& p) { return p.x(); });
    const Index b = most([&](const Vec3& p) { return (p - points_[a]).norm(); });
    const double size = (points_[b] - points_[a]).norm();
    const Vec3 along = (points_[b] - points_[a]) / size;
    const Index c = most([&](const Vec3& p) { return (p - points_[a]).cross(along).norm(); });
    const Vec3 across = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    const Index d = most([&](const Vec3& p) { return std::abs(across.dot(p - points_[a])); });
    flat_ = kFlat * size;
    if (!(size > 0.0) || !(across.norm() > flat_ * size)) return false;
    const double above = across.normalized().dot(points_[d] - points_[a]);
    if (!(std::abs(above) > flat_)) return false;
    faces_ = {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}};
    if (above > 0.0)
      for (Triangle& face : faces_) std::swap(face[1], face[2]);
    return true;
  }

  /// The point farthest above any face.
  std::optional<Outside> farthest() const {
    std::optional<Outside> found;
    double most = flat_;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (Index i = 0; i < points_.size(); ++i)
        if (const double h = height(faces_[f], i); h > most) most = h, found = Outside{f, i};
    return found;
  }

  /// Replaces the faces that see a point, which are joined to the given one, by faces between their border
  /// and the point.
  void grow(std::size_t first, Index point) {
    std::map<std::pair<Index, Index>, std::size_t> face_of_edge;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) face_of_edge[{faces_[f][k], faces_[f][(k + 1) % 3]}] = f;
    std::vector<bool> seen(faces_.size(), false);
    std::vector<std::size_t> open{first};
    std::vector<Triangle> fresh;
    seen[first] = true;
    while (!open.empty()) {
      const Triangle face = faces_[open.back()];
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t beyond = face_of_edge.at({face[(k + 1) % 3], face[k]});
        if (seen[beyond]) continue;
        if (height(faces_[beyond], point) > 0.0) seen[beyond] = true, open.push_back(beyond);
      }
    }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; seen[f] && k < 3; ++k) {
        const Index from = faces_[f][k], to = faces_[f][(k + 1) % 3];
        if (!seen[face_of_edge.at({to, from})]) fresh.push_back({from, to, point});
      }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (!seen[f]) fresh.push_back(faces_[f]);
    faces_ = std::move(fresh);
  }

  std::span<const Vec3> points_;
  std::vector<Triangle> faces_;
  double flat_ = 0.0;
};

}  // namespace

geometry::TriMesh convex_hull(std::span<const Vec3> points) {
  Hull hull(points);
  return hull.run() ? hull.mesh() : geometry::TriMesh{};
}

}  // namespace bodice::colliders
