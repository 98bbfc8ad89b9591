// Garments in the order that is given, from the body outward, and layers that cross in their files.
#include <doctest/doctest.h>

#include <bodice/geometry/crossings.hpp>
#include <bodice/tryon/layers.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using geometry::Index;
using geometry::Vec3;

namespace {

constexpr Index kAround = 48, kRows = 20;

/// A tube about y of 48 quads around and 20 up, each cut in two, with a radius that may vary.
template <class Radius>
tryon::WornGarment tube(const char* name, Radius&& radius, double lowest_m = -0.15) {
  tryon::WornGarment garment{.name = name, .mesh = {}, .held = {}};
  for (Index j = 0; j <= kRows; ++j)
    for (Index i = 0; i < kAround; ++i) {
      const double angle = 6.283185307179586 * i / kAround, r = radius(angle + 0.4 * j);
      garment.mesh.positions.emplace_back(r * std::cos(angle), 0.3 * j / kRows + lowest_m,
                                          r * std::sin(angle));
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

namespace {

/// A bodice and a skirt of one file. Over 4.5 cm they overlap, and cross as waves that are `deep_m` high; the
/// skirt is `farther_m` farther from the skin on average.
geometry::TriMesh bodice_and_skirt(double deep_m, double farther_m) {
  const auto bodice = tube("bodice", [](double) { return 0.31; });
  const auto skirt = tube(
      "skirt", [&](double angle) { return 0.31 + farther_m + deep_m * std::sin(3.0 * angle + 0.1); }, -0.405);
  return tryon::join({bodice, skirt})->mesh;
}

/// The distance from the axis of the vertices `first` to `last`: mean, and the farthest that one has moved.
struct Radii {
  double mean_m = 0.0, moved_m = 0.0;
};

Radii radii(const geometry::TriMesh& mesh, const geometry::TriMesh& before, std::size_t first,
            std::size_t last) {
  Radii r;
  for (std::size_t v = first; v < last; ++v) {
    r.mean_m += std::hypot(mesh.positions[v].x(), mesh.positions[v].z()) / static_cast<double>(last - first);
    r.moved_m = std::max(r.moved_m, (mesh.positions[v] - before.positions[v]).norm());
  }
  return r;
}

}  // namespace

TEST_CASE("layers: a bodice and a skirt that cross are separated, and the outer one is moved") {
  const Layers l;
  for (const double farther_m : {0.001, -0.001}) {
    CAPTURE(farther_m);
    const geometry::TriMesh before = bodice_and_skirt(0.004, farther_m);
    geometry::TriMesh mesh = before;
    const auto separated = tryon::separate_layers(l.context, l.skin, 0.002, mesh);
    CHECK(separated.before == geometry::find_crossings(before.positions, before.triangles).size());
    CHECK(separated.before > 100);
    CHECK(separated.after == 0);
    CHECK(geometry::find_crossings(mesh.positions, mesh.triangles).empty());
    const std::size_t half = mesh.positions.size() / 2;
    const Radii bodice = radii(mesh, before, 0, half), skirt = radii(mesh, before, half, 2 * half);
    const Radii &outer = farther_m > 0.0 ? skirt : bodice, &inner = farther_m > 0.0 ? bodice : skirt;
    CHECK(inner.moved_m == 0.0);
    CHECK(outer.moved_m > 0.002);
    CHECK(outer.moved_m <= 0.015);
  }
}

TEST_CASE("layers: vertices at one position move alike where layers are separated") {
  const Layers l;
  geometry::TriMesh mesh = bodice_and_skirt(0.004, 0.001);
  const std::size_t count = mesh.positions.size();
  // The skirt's triangles on one side get vertices of their own, as a file has them along a texture's seam.
  for (geometry::Triangle& t : mesh.triangles)
    if (t[0] >= count / 2 && mesh.positions[t[0]].x() > 0.0)
      for (Index& v : t) {
        mesh.positions.push_back(mesh.positions[v]);
        v = static_cast<Index>(mesh.positions.size() - 1);
      }
  std::vector<std::pair<Index, Index>> copies;
  for (Index v = static_cast<Index>(count); v < mesh.positions.size(); ++v)
    for (Index w = 0; w < count; ++w)
      if (mesh.positions[v] == mesh.positions[w]) copies.emplace_back(v, w);
  REQUIRE(copies.size() > 1000);
  const geometry::TriMesh before = mesh;
  tryon::separate_layers(l.context, l.skin, 0.002, mesh);
  CHECK(mesh.positions != before.positions);
  for (const auto& [v, w] : copies) CHECK(mesh.positions[v] == mesh.positions[w]);
}

TEST_CASE("layers: what is too deep to be separated does not cross more than before") {
  const Layers l;
  const geometry::TriMesh before = bodice_and_skirt(0.03, 0.001);
  geometry::TriMesh mesh = before;
  const auto separated = tryon::separate_layers(l.context, l.skin, 0.002, mesh);
  CHECK(separated.after == geometry::find_crossings(mesh.positions, mesh.triangles).size());
  CHECK(separated.after > 0);
  CHECK(separated.after <= separated.before);
  CHECK(radii(mesh, before, 0, mesh.positions.size()).moved_m <= 0.015);
}

TEST_CASE("layers: a surface that crosses itself is smoothed there, outside of the skin") {
  const Layers l;
  tryon::WornGarment garment = tube("cotton", [](double) { return 0.303; });
  const auto row = static_cast<std::size_t>(kAround) * 10;
  for (std::size_t i = 0; i < kAround / 4; ++i)  // a part of a row is pulled down through the rows below it
    garment.mesh.positions[row + i] += Vec3(0.002 * (i % 2 == 0 ? 1.0 : -1.0), -0.017, 0.0);
  const geometry::TriMesh before = garment.mesh;
  REQUIRE(!geometry::find_crossings(before.positions, before.triangles).empty());
  const auto separated = tryon::separate_layers(l.context, l.skin, 0.002, garment.mesh);
  CHECK(separated.after == 0);
  std::size_t moved = 0;
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    const Vec3 &from = before.positions[v], &to = garment.mesh.positions[v];
    moved += from != to;
    const double least_m = std::min(l.skin.signed_distance(from), 0.004);
    CHECK(l.skin.signed_distance(to) >= least_m - 1e-4);
  }
  CHECK(moved > 0);
  CHECK(moved < before.positions.size() / 4);
}
