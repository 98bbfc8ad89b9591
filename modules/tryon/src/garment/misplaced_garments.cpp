#include "garment/misplaced_garments.hpp"

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

// Distances and sizes in statures.
constexpr double kNear = 0.25;                      // a poncho may begin above the head
constexpr double kSmallest = 0.03, kLargest = 4.0;  // a wristband and a train are within

bool is_near(const geometry::TriMesh& garment, const PreparedBody& body, double within_m) {
  for (const geometry::Vec3& p : garment.positions)
    if (p.allFinite() && body.skin.distance->closest_point_within(p, within_m)) return true;
  return false;
}

double diagonal_m(const geometry::TriMesh& garment) {
  geometry::Box box;
  for (const geometry::Vec3& p : garment.positions)
    if (p.allFinite()) box.extend(p);
  return box.size().norm();
}

}  // namespace

void warn_of_misplaced(const std::vector<WornGarment>& garments, const PreparedBody& body,
                       std::vector<engine::Warning>& warnings) {
  const double stature_m = body.fit.proxy.stature_m();
  for (const WornGarment& garment : garments) {
    const double size_m = diagonal_m(garment.mesh);
    if (!(size_m > kSmallest * stature_m && size_m < kLargest * stature_m))
      warnings.push_back({"garment-size", garment.name,
                          engine::message("The garment is ", size_m,
                                          " m from corner to corner, beside a body of ", stature_m, " m."),
                          "Check that both are in the same units."});
    else if (!is_near(garment.mesh, body, kNear * stature_m))
      warnings.push_back({"garment-far", garment.name, "No vertex of the garment is near the body.",
                          "Check that both have the same origin and units."});
  }
}

}  // namespace bodice::tryon
