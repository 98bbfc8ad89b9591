#include "body/stand_upright.hpp"

#include <algorithm>

namespace bodice::inline v0_1::tryon {
namespace {

using body::LandmarkId;
using geometry::Vec3;

/// A direction within 32 degrees of an axis is along it.
constexpr double kAlong = 0.85;

Vec3 position(const anatomy::Anatomy& anatomy, LandmarkId id) {
  return anatomy.landmarks[static_cast<std::size_t>(id)].position;
}

/// Whether a lower leg stands along the y axis, as it does in a body that bends over.
bool stands_on_calf(const anatomy::Anatomy& anatomy) {
  for (int side = 0; side < 2; ++side) {
    const Vec3 calf = position(anatomy, of_side(LandmarkId::kKneeL, side)) -
                      position(anatomy, of_side(LandmarkId::kAnkleL, side));
    if (calf.y() > kAlong * calf.norm()) return true;
  }
  return false;
}

}  // namespace

bool stand_upright(io::ImportedMesh& mesh, anatomy::Anatomy& anatomy) {
  if (!mesh.up_found_by_extents) return false;
  const Vec3 trunk = mesh.frame.direction_to_file(anatomy.up);
  Eigen::Index axis = 1;
  const double along = trunk.maxCoeff(&axis);  // frames have no axis that points down
  const auto up = static_cast<geometry::Axis>(axis);
  if (along < kAlong || up == mesh.frame.up || stands_on_calf(anatomy)) return false;
  const geometry::Mat3 back = mesh.frame.rotation().transpose();
  mesh.frame.up = up;
  const geometry::Mat3 turn = mesh.frame.rotation() * back;
  for (Vec3& p : mesh.skin.positions) p = turn * p;
  for (body::Landmark& mark : anatomy.landmarks) mark.position = turn * mark.position;
  anatomy.up = turn * anatomy.up;
  return true;
}

}  // namespace bodice::tryon
