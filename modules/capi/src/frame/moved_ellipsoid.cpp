#include "frame/moved_ellipsoid.hpp"

#include <bodice/geometry/similarity.hpp>

namespace bodice::inline v0_1::capi {

std::string_view move_ellipsoid(const geometry::Ellipsoid& rest, const proxy::JointMatrix& map,
                                geometry::Ellipsoid& out) {
  if (!map.allFinite()) return "is not finite";
  const geometry::Mat3 linear = map.leftCols<3>();
  const geometry::Similarity found = geometry::similarity_of(linear);
  if (!found.refusal.empty()) return found.refusal;
  out.center = linear * rest.center + map.col(3);
  out.axes = found.rotation * rest.axes;
  out.radii = found.scale * rest.radii;
  return {};
}

}  // namespace bodice::capi
