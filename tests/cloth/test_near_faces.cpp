// Fast bounds of the distances of leaves, compared with loops over all triangles.
#include <doctest/doctest.h>

#include <numbers>
#include <random>

#include "layer_fixtures.hpp"
#include "pairs/face_pair.hpp"
#include "pairs/near_faces.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

Eigen::AlignedBox3d box_of(const cloth::Face& face, std::span<const cloth::Point> at) {
  Eigen::AlignedBox3d box;
  for (const Index i : face.particle) box.extend(Eigen::Vector3f(at[i].x, at[i].y, at[i].z).cast<double>());
  return box;
}

}  // namespace

TEST_CASE(
    "near faces: a patch is flat up to 60 degrees from its mean normal, and may turn up to 75 degrees") {
  for (const double degrees : {0.0, 20.0, 60.0, 90.0, 115.0, 119.0, 121.0, 150.0, 170.0}) {
    CAPTURE(degrees);
    const double angle = degrees * std::numbers::pi / 180.0;
    const TriMesh mesh = folded_strip(angle);
    const cloth::ContactMesh leaves = cloth::make_contact_mesh(mesh);
    REQUIRE(leaves.leaves() == 2);
    const float left_m = cloth::travel_while_flat(leaves, 0, 1, points_of(mesh.positions));
    const double wanted =
        degrees > 120.0 ? 0.0 : kStripHeight_m * std::sin((75.0 - degrees / 2) * std::numbers::pi / 180.0);
    CHECK(double{left_m} == doctest::Approx(wanted).epsilon(1e-4));
  }
}

TEST_CASE("near faces: the distance of two leaves is the least distance of their triangles' boxes") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 0.1);
  for (int round = 0; round < 200; ++round) {
    TriMesh mesh = surface(8, 8, false, [](double u, double v) { return Vec3(u, 0, v); });
    for (Vec3& p : mesh.positions) p += Vec3(normal(random), 3 * normal(random), normal(random));
    const cloth::ContactMesh leaves = cloth::make_contact_mesh(mesh);
    const std::vector<cloth::Point> at = points_of(mesh.positions);
    const std::size_t a = round % leaves.leaves(),
                      b = (a + 1 + round / 7 % (leaves.leaves() - 1)) % leaves.leaves();
    double least = INFINITY;
    for (const cloth::Face& f : leaves.faces_of(a))
      for (const cloth::Face& g : leaves.faces_of(b))
        least = std::min(least, box_of(f, at).exteriorDistance(box_of(g, at)));
    CHECK(double{cloth::FaceBoxes(leaves, at, a, b).distance()} == doctest::Approx(least).epsilon(1e-5));
  }
}
