// A hole in a table is found even if no grid of samples has a point in it.
#include <doctest/doctest.h>

#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/proxy/proxy_distance.hpp>

#include "relief/relief_holes.hpp"
#include "shapes.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr int kNodes = 16;
constexpr double kDepth_m = 0.007, kMargin_m = 0.002;

/// A proxy of one ellipsoid that is its skin; the table cuts `cut_m` at a single node and nothing elsewhere.
proxy::BodyProxy::Data with_one_bad_node(const geometry::Ellipsoid& shape, double cut_m) {
  proxy::BodyProxy::Data data;
  data.tier = proxy::Tier::kRelief;
  data.stature_m = 1.7;
  data.ellipsoids = {{shape, body::Part::kTorsoUL}};
  data.relief.resize(1);
  data.relief[0].nodes_per_side = kNodes;
  data.relief[0].h_offset_m = static_cast<float>(-cut_m);
  data.relief[0].h_scale_m = static_cast<float>(cut_m);
  data.texels.assign(kNodes * kNodes, {255, 0});
  data.texels[5 * kNodes + 6].h = 0;
  return data;
}

}  // namespace

TEST_CASE("relief holes: a single node that cuts deep is a hole, and one that cuts less is none") {
  const geometry::Ellipsoid shape{Vec3(0, 1, 0), geometry::Mat3::Identity(), Vec3(0.15, 0.2, 0.12)};
  fitting_test::Skin skin;
  fitting_test::add_ellipsoid(skin, shape, body::Part::kTorsoUL, 48);
  skin.stature_m = 1.7;
  const geometry::MeshDistance distance({}, skin.mesh);
  auto view = skin.view();
  view.distance = &distance;
  const auto source = fitting::make_skin_source({}, view, fitting::kAllParts);
  const fitting::FreeSkin free_skin({}, source);
  const auto bad = with_one_bad_node(shape, 0.025);
  const auto holes = fitting::find_holes({}, free_skin, bad, kDepth_m, kMargin_m);
  CHECK(holes.size() > 3);
  for (const Vec3& hole : holes) {
    CHECK(distance.closest_point(hole).signed_distance <= -kDepth_m);
    CHECK(proxy::proxy_distance(bad, hole).distance >= -kMargin_m);
  }
  CHECK(fitting::find_holes({}, free_skin, with_one_bad_node(shape, 0.004), kDepth_m, kMargin_m).empty());
}
