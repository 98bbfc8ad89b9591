// The proxy of a body in another shape of the same vertices is compared with one that is fitted to that
// shape.

#include <doctest/doctest.h>

#include <cmath>

#include <bodice/tryon/judge_frame.hpp>
#include <bodice/tryon/reshape.hpp>

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr double kNear_m = 0.03;

/// Wider around the waist and the hips by at most `by_m`, as a slider of girth moves the vertices.
std::vector<Vec3> widened(const tryon::SegmentedSkin& skin, double by_m) {
  const std::vector<Vec3> normals = geometry::vertex_normals(skin.input.skin);
  std::vector<Vec3> positions = skin.input.skin.positions;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const double off = (positions[v].y() / skin.anatomy.stature_m - 0.55) / 0.1;
    const body::Part part = skin.anatomy.part[v];
    const bool arm = part == body::Part::kUpperArmL || part == body::Part::kUpperArmR ||
                     part == body::Part::kForearmL || part == body::Part::kForearmR;
    if (!arm) positions[v] += by_m * std::exp(-0.5 * off * off) * normals[v];
  }
  return positions;
}

double mean_error_m(const tryon::SegmentedSkin& skin, const proxy::BodyProxy& proxy) {
  return tryon::measure_proxy_error({}, collision::Collider(proxy), skin.input.skin, *skin.distance, kNear_m)
      .error_m.mean;
}

}  // namespace

TEST_CASE(
    "after a slider of girth, the error is at most 1.2 times that of a new fit, and far below the old "
    "proxy's") {
  auto skin = tryon::segment_builtin({}, {}, {});
  REQUIRE(skin);
  const fitting::FitOptions options{.measure_accuracy = false};
  const auto fitted = tryon::fit_proxy({}, *skin, options, {});
  REQUIRE(fitted);
  for (const double by_m : {0.0125, 0.025}) {
    CAPTURE(by_m);
    const auto shape = tryon::reshape_body({}, *skin, fitted->fit.proxy, widened(*skin, by_m));
    REQUIRE(shape);
    const double error_m = mean_error_m(*shape->skin, shape->proxy);
    const auto scratch = tryon::fit_proxy({}, *shape->skin, options, {});
    REQUIRE(scratch);
    const double scratch_m = mean_error_m(*shape->skin, scratch->fit.proxy);
    CAPTURE(error_m);
    CAPTURE(scratch_m);
    CHECK(error_m <= 1.2 * scratch_m);
    // The old proxy is measured against the new skin: the error without a refit.
    CHECK(error_m < 0.5 * mean_error_m(*shape->skin, fitted->fit.proxy));
  }
}
