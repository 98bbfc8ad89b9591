// Garments in the order that is given, from the body outward.
#include <doctest/doctest.h>

#include <bodice/geometry/crossings.hpp>
#include <bodice/tryon/layers.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using geometry::Index;
using geometry::Vec3;

namespace {

/// A tube about y of 48 quads around and 20 up, each cut in two, with a radius that may vary.
template <class Radius>
tryon::WornGarment tube(const char* name, Radius&& radius) {
  constexpr Index kAround = 48, kRows = 20;
  tryon::WornGarment garment{.name = name, .mesh = {}, .held = {}};
  for (Index j = 0; j <= kRows; ++j)
    for (Index i = 0; i < kAround; ++i) {
      const double angle = 6.283185307179586 * i / kAround, r = radius(angle + 0.4 * j);
      garment.mesh.positions.emplace_back(r * std::cos(angle), 0.3 * j / kRows - 0.15, r * std::sin(angle));
    }
  for (Index j = 0; j < kRows; ++j)
    for (Index i = 0; i < kAround; ++i) {
      const Index a = j * kAround + i, b = j * kAround + (i + 1) % kAround, c = a + kAround, d = b + kAround;
      garment.mesh.triangles.insert(garment.mesh.triangles.end(), {{a, c, b}, {b, c, d}});
    }
  return garment;
}

std::size_t crossings(const std::vector<tryon::WornGarment>& garments) {
  const auto all = tryon::join(garments);
  REQUIRE(all.ok());
  return geometry::find_crossings(all->mesh.positions, all->mesh.triangles).size();
}

double least_radius(const tryon::WornGarment& g) {
  double least = 1e9;
  for (const Vec3& p : g.mesh.positions) least = std::min(least, std::hypot(p.x(), p.z()));
  return least;
}

struct Layers {
  const engine::Context context;
  const geometry::MeshDistance skin{context, bodice_test::cylinder(0.3, 1.0, 48, 10)};
  std::vector<tryon::WornGarment> garments = {
      tube("shirt", [](double) { return 0.35; }),
      tube("trousers", [](double angle) { return 0.35 + 0.01 * std::sin(3.0 * angle + 0.1); })};
};

}  // namespace

TEST_CASE("layers: two garments that cross are laid over each other in either order") {
  const Layers l;
  CHECK(crossings(l.garments) > 100);
  for (const bool tucked : {true, false}) {
    const std::vector<std::string> order = tucked ? std::vector<std::string>{"shirt", "trousers"}
                                                  : std::vector<std::string>{"trousers", "shirt"};
    const auto laid = tryon::order_layers(l.context, l.skin, order, l.garments, 0.002);
    REQUIRE(laid.ok());
    CHECK(crossings(*laid) == 0);
    const auto &inner = (*laid)[tucked ? 0 : 1], &outer = (*laid)[tucked ? 1 : 0];
    CHECK(inner.mesh.positions == l.garments[tucked ? 0 : 1].mesh.positions);
    CHECK(least_radius(outer) > least_radius(inner));
  }
}

TEST_CASE("layers: an order with an unknown or a repeated name fails and lists the garments") {
  const Layers l;
  for (const std::vector<std::string>& order :
       {std::vector<std::string>{"shirt", "coat"}, {"shirt", "shirt"}}) {
    const auto laid = tryon::order_layers(l.context, l.skin, order, l.garments, 0.002);
    REQUIRE_FALSE(laid.ok());
    CHECK(laid.error().code == engine::ErrorCode::kInvalidArgument);
    CHECK(laid.error().sentence().find("shirt, trousers") != std::string::npos);
  }
}
