// Samples in the air are found where a union stands in the air, and only there.
#include <doctest/doctest.h>

#include <bodice/geometry/mesh_distance.hpp>

#include "shapes.hpp"
#include "skin/air_samples.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr double kGap_m = 0.008, kMost_m = 0.2;

/// The samples in the air of ellipsoids next to two legs, 20 cm apart.
std::vector<fitting::DistanceSample> samples_of(const std::vector<geometry::Ellipsoid>& ellipsoids,
                                                const geometry::MeshDistance& distance,
                                                const fitting_test::Skin& skin) {
  auto view = skin.view();
  view.distance = &distance;
  const auto source = fitting::make_skin_source({}, view, fitting::kAllParts);
  return fitting::samples_in_air({}, source, ellipsoids, 2000, kGap_m, kMost_m);
}

}  // namespace

TEST_CASE("air samples: an ellipsoid across the gap between two legs gets samples with their true distance") {
  const geometry::Ellipsoid left{Vec3(0.1, 0.4, 0), geometry::Mat3::Identity(), Vec3(0.05, 0.4, 0.05)};
  const geometry::Ellipsoid right{Vec3(-0.1, 0.4, 0), geometry::Mat3::Identity(), Vec3(0.05, 0.4, 0.05)};
  const geometry::Ellipsoid across{Vec3(0, 0.4, 0), geometry::Mat3::Identity(), Vec3(0.15, 0.4, 0.05)};
  fitting_test::Skin skin;
  fitting_test::add_ellipsoid(skin, left, body::Part::kThighL);
  fitting_test::add_ellipsoid(skin, right, body::Part::kThighR);
  skin.stature_m = 1.7;
  const geometry::MeshDistance distance({}, skin.mesh);
  CHECK(samples_of({left, right}, distance, skin).empty());
  const geometry::Ellipsoid behind{Vec3(0, 0.4, 0.03), geometry::Mat3::Identity(), Vec3(0.12, 0.3, 0.05)};
  const auto samples = samples_of({left, across, behind}, distance, skin);
  CHECK(samples.size() > 200);
  for (const auto& s : samples) {
    CHECK(s.signed_distance_m > kGap_m);
    CHECK(s.signed_distance_m ==
          doctest::Approx(distance.closest_point(s.point).signed_distance).epsilon(1e-9));
    for (const auto& e :
         {left, across, behind})  // a point inside another ellipsoid is not on the union's surface
      CHECK(geometry::level(e, s.point) > 1.0 - 1e-9);
  }
}
