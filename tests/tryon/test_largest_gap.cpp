// The largest gap that a fit reports, beside the surface of its proxy as a mesh.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/proxy/proxy_surface.hpp>
#include <bodice/tryon/prepare.hpp>
#include <bodice_test/data.hpp>

using namespace bodice;

TEST_CASE("the largest reported gap includes lumps of relief on a skin with folds") {
  const auto file = bodice_test::data_file("rigs/thirdparty/posed_Female_Walking.fbx");
  if (!file) return;
  const auto skin = tryon::segment_file({}, *file, {});
  REQUIRE(skin);
  const auto body = tryon::fit_proxy({}, *skin, {});
  REQUIRE(body);
  const auto surface = proxy::proxy_surface({}, body->fit.proxy, 0.01);
  REQUIRE(surface);
  double largest_m = 0.0;
  for (const geometry::Vec3& p : surface->mesh.positions)
    largest_m = std::max(largest_m, skin->distance->signed_distance(p));
  CAPTURE(largest_m);
  const double reported_m = body->fit.accuracy.gap_m.max;
  CHECK(largest_m > 0.02);  // otherwise the file would not have the lumps that this tests
  CHECK(reported_m > 0.5 * largest_m);
  CHECK(reported_m < largest_m + 0.005);
}
