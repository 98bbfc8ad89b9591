#include "skin/free_skin.hpp"

#include <algorithm>

#include <bodice/engine/parallel.hpp>

#include "skin/buried_skin.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

/// One flag a triangle: whether its middle is buried. SkinSource::buried flags every triangle with a buried
/// corner, but one with its middle in the open bounds the body all the same.
std::vector<std::uint8_t> buried_to_the_middle(const engine::Context& context, const SkinSource& source) {
  const geometry::TriMesh& mesh = source.skin.mesh;
  std::vector<std::uint8_t> buried = source.buried;
  engine::parallel_for(context, buried.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (!buried[t]) continue;
      const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
      const Vec3 normal = geometry::area_vector(mesh, t).stableNormalized();
      buried[t] = source.skin.distance->inside(middle + kStepOffSkin * source.skin.stature_m * normal);
    }
  });
  return buried;
}

}  // namespace

FreeSkin::FreeSkin(const engine::Context& context, const SkinSource& source)
    : source_(source), distance_(source.skin.distance) {
  if (std::find(source.buried.begin(), source.buried.end(), 1) == source.buried.end()) return;
  buried_ = buried_to_the_middle(context, source);
  const geometry::TriMesh& mesh = source.skin.mesh;
  geometry::TriMesh open{mesh.positions, {}};
  for (geometry::Index t = 0; t < buried_.size(); ++t) {
    if (buried_[t]) continue;
    free_.push_back(t);
    open.triangles.push_back(mesh.triangles[t]);
  }
  own_ = std::make_unique<geometry::MeshDistance>(context, open);
  distance_ = own_.get();
}

body::Part FreeSkin::part(const geometry::SurfacePoint& hit) const {
  const geometry::Index triangle = free_.empty() ? hit.triangle : free_[hit.triangle];
  return source_.skin.part[source_.skin.mesh.triangles[triangle][0]];
}

}  // namespace bodice::fitting
