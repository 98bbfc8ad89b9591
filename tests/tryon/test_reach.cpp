// Parts that a garment cannot reach are left out, and distances where it can are as before. They have the
// same bits where parts are fitted one by one, and the same accuracy where neighbors are fitted together.

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/sampling.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/reach.hpp>
#include <bodice/tryon/wearing.hpp>
#include <bodice_test/executors.hpp>

#include "builtin.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr double kMargin_m = 0.05;

struct Skirted {
  tryon::SegmentedSkin skin;
  geometry::TriMesh skirt;
  std::vector<Vec3> points;      ///< points within half the margin of the skirt
  std::vector<double> depths_m;  ///< the true signed distance of each
};

Skirted dress() {
  const tryon::SegmentedSkin& skin = builtin_skin(3000);
  auto cut = tryon::make_garment({}, skin, {.kind = synth::GarmentKind::kSkirt, .edge_length_m = 0.03});
  REQUIRE(cut.ok());
  Skirted dressed{skin, std::move(cut->mesh), {}, {}};
  engine::Random random(7);
  for (const Vec3& p : dressed.skirt.positions)
    for (int k = 0; k < 4; ++k) {
      const double a = random.normal(), b = random.normal(), c = random.normal();
      const Vec3 point = p + 0.5 * kMargin_m * random.uniform() * Vec3(a, b, c).stableNormalized();
      dressed.points.push_back(point);
      dressed.depths_m.push_back(dressed.skin.distance->signed_distance(point));
    }
  return dressed;
}

const Skirted& dressed() {
  static const Skirted made = dress();  // made once for all cases
  return made;
}

proxy::BodyProxy fit(proxy::Tier tier, std::uint32_t parts) {
  auto fitted =
      fitting::fit({}, tryon::labeled(dressed().skin), {.tier = tier, .max_ellipsoids = 45, .parts = parts});
  REQUIRE_MESSAGE(fitted.ok(), fitted.error().sentence());
  return fitted->proxy;
}

std::uint32_t reached() {
  return tryon::reachable_parts({}, dressed().skin, {&dressed().skirt, 1}, kMargin_m).value();
}

double at(const proxy::BodyProxy& proxy, const Vec3& point) {
  return proxy::proxy_distance(proxy, point).distance;
}

struct Differences {
  std::size_t count = 0, other_bits = 0;
  double apart_m = 0.0, whole_error_m = 0.0, region_error_m = 0.0;  ///< means
};

/// Compares two proxies at points that a garment acts on: those within half the margin of the body.
Differences compare(const proxy::BodyProxy& whole, const proxy::BodyProxy& region) {
  Differences d;
  for (std::size_t i = 0; i < dressed().points.size(); ++i) {
    const double a = at(whole, dressed().points[i]);
    if (a > 0.5 * kMargin_m) continue;
    const double b = at(region, dressed().points[i]);
    ++d.count;
    d.other_bits += a != b;
    d.apart_m += std::abs(a - b);
    d.whole_error_m += std::abs(a - dressed().depths_m[i]);
    d.region_error_m += std::abs(b - dressed().depths_m[i]);
  }
  for (double* sum : {&d.apart_m, &d.whole_error_m, &d.region_error_m}) *sum /= static_cast<double>(d.count);
  return d;
}

/// Whether the part is a hand or the head, which a skirt does not reach.
bool is_far_from_skirts(body::Part part) {
  using body::Part;
  return part == Part::kHead || part == Part::kUpperArmL || part == Part::kUpperArmR ||
         part == Part::kForearmL || part == Part::kForearmR;
}

}  // namespace

TEST_CASE("every part with a point of skin within the margin is reached, however large its triangles are") {
  const geometry::TriMesh& skin = dressed().skin.input.skin;
  const Vec3 above(0.0, 1e-3, 0.0);
  const auto points = geometry::sample_surface(skin, 2000, 3);
  REQUIRE(points.size() == 2000);
  for (const geometry::SurfaceSample& sample : points) {
    // The garment is tiny and lies at a point between the vertices.
    const geometry::TriMesh speck{{sample.point, sample.point + above, sample.point + 2.0 * above},
                                  {{0, 1, 2}}};
    const std::uint32_t found = tryon::reachable_parts({}, dressed().skin, {&speck, 1}, 1e-4).value();
    for (const geometry::Index v : skin.triangles[sample.triangle])
      REQUIRE((found & 1u << static_cast<int>(dressed().skin.anatomy.part[v])) != 0);
    REQUIRE(std::popcount(found) <= 4);  // beside it only its neighbors
  }
}

TEST_CASE("paper and solid distances have the same bits in the region as in the whole body") {
  for (const proxy::Tier tier : {proxy::Tier::kPaper, proxy::Tier::kSolid}) {
    CAPTURE(proxy::name(tier));
    const proxy::BodyProxy whole = fit(tier, fitting::kAllParts), region = fit(tier, reached());
    CHECK(region.ellipsoids().size() < whole.ellipsoids().size());
    CHECK(region.bytes() < whole.bytes());
    for (const proxy::ProxyEllipsoid& e : region.ellipsoids()) CHECK_FALSE(is_far_from_skirts(e.part));
    const Differences d = compare(whole, region);
    CHECK(d.count > 300);
    CHECK(d.other_bits == 0);
  }
}

TEST_CASE("within the region, tiers tight and relief are as accurate as in a fit of the whole body") {
  for (const proxy::Tier tier : {proxy::Tier::kTight, proxy::Tier::kRelief}) {
    CAPTURE(proxy::name(tier));
    const proxy::BodyProxy whole = fit(tier, fitting::kAllParts), region = fit(tier, reached());
    CHECK(region.ellipsoids().size() < whole.ellipsoids().size());
    const Differences d = compare(whole, region);
    CHECK(d.count > 300);
    CAPTURE(d.whole_error_m);
    CHECK(d.region_error_m < 1.25 * d.whole_error_m);
    CHECK(d.apart_m <
          2.0 * d.whole_error_m);  // neither is exact: they differ by no more than the sum of their errors
  }
}

TEST_CASE("a cropped proxy has unchanged distances within reach, in every tier") {
  for (const proxy::Tier tier :
       {proxy::Tier::kPaper, proxy::Tier::kSolid, proxy::Tier::kTight, proxy::Tier::kRelief}) {
    CAPTURE(proxy::name(tier));
    const proxy::BodyProxy whole = fit(tier, fitting::kAllParts);
    const auto near = tryon::within_reach({}, whole, {&dressed().skirt, 1}, kMargin_m);
    REQUIRE(near.ok());
    CHECK(near->ellipsoids().size() < whole.ellipsoids().size());
    CHECK(near->bytes() < whole.bytes());
    // Ellipsoids of tight and relief cover best across borders: one that bounds the neck may fill the chest.
    const bool within_parts = tier == proxy::Tier::kPaper || tier == proxy::Tier::kSolid;
    for (const proxy::ProxyEllipsoid& e : near->ellipsoids())
      CHECK_FALSE((within_parts && is_far_from_skirts(e.part)));
    CHECK(compare(whole, *near).other_bits == 0);
    const auto threads = bodice_test::make_threads(3);
    const auto again =
        tryon::within_reach({.executor = threads.get()}, whole, {&dressed().skirt, 1}, kMargin_m);
    REQUIRE(again.ok());
    CHECK(again->hash() == near->hash());
  }
}

TEST_CASE("a garment out of reach and an invalid margin are errors with a remedy") {
  const proxy::BodyProxy whole = fit(proxy::Tier::kPaper, fitting::kAllParts);
  geometry::TriMesh far = dressed().skirt;
  for (Vec3& p : far.positions) p.x() += 10.0;
  const auto none = tryon::within_reach({}, whole, {&far, 1}, kMargin_m);
  REQUIRE_FALSE(none.ok());
  CHECK(none.error().code == engine::ErrorCode::kUnusableGeometry);
  CHECK_FALSE(tryon::within_reach({}, whole, {}, kMargin_m).ok());
  far.positions[0].x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(tryon::within_reach({}, whole, {&far, 1}, kMargin_m).ok());
  for (const double margin_m :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto result = tryon::within_reach({}, whole, {&dressed().skirt, 1}, margin_m);
    REQUIRE_FALSE(result.ok());
    CHECK(result.error().code == engine::ErrorCode::kInvalidArgument);
    const auto parts = tryon::reachable_parts({}, dressed().skin, {&dressed().skirt, 1}, margin_m);
    REQUIRE_FALSE(parts.ok());
    CHECK(parts.error().code == engine::ErrorCode::kInvalidArgument);
  }
  // With this margin everything is within reach.
  CHECK(tryon::within_reach({}, whole, {&dressed().skirt, 1}, 10.0)->hash() == whole.hash());
}
