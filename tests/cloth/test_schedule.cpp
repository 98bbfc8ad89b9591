// Constraints are reordered into packs, with particles as indices within a block: none may be lost or
// changed.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <set>

#include "constraints/bend.hpp"
#include "constraints/stretch.hpp"
#include "fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

/// A garment with more particles than 16 bits can index.
struct Garment {
  TriMesh mesh = sheet(270, 250, 2.7, 2.5, Vec3::Zero());
  cloth::Topology topology = cloth::find_topology(mesh);
  cloth::Particles particles =
      cloth::make_particles(mesh, 0.1, std::vector<bool>(mesh.positions.size(), false));
};

/// Calls visit(pack, first) for all packs; their particles are stored relative to `first`.
template <class Constraints, class Visit>
void for_each_pack(const Constraints& c, std::size_t particle_count, Visit&& visit) {
  const std::size_t size = cloth::block_size(particle_count);
  for (std::size_t b = 0; b < c.schedule.blocks(); ++b)
    for (const auto& pack : c.schedule.inside(std::span(c.inside), b)) visit(pack, b * size);
  for (const auto& pack : c.across) visit(pack, std::size_t{0});
}

/// The particles of a constraint in a pack, ascending.
template <std::size_t arity, class Name>
std::array<std::size_t, arity> named(std::size_t first, Name&& name) {
  std::array<std::size_t, arity> out;
  for (std::size_t q = 0; q < arity; ++q) out[q] = first + name(q);
  std::ranges::sort(out);
  return out;
}

}  // namespace

TEST_CASE(
    "schedule: each edge of a large garment is in one pack, and the edges of a pack share no particle") {
  const Garment g;
  REQUIRE(g.particles.count() > 65536);
  const cloth::StretchConstraints c = cloth::make_stretch(g.mesh, g.topology, cotton(), g.particles);
  std::set<std::array<std::size_t, 2>> expected, found;
  for (const cloth::Edge& e : g.topology.edges) expected.insert({e.a, e.b});
  std::size_t edges = 0;
  for_each_pack(c, g.particles.count(), [&](const auto& pack, std::size_t first) {
    std::set<std::size_t> taken;
    std::size_t own = 0;
    for (std::size_t k = 0; k < cloth::kPack; ++k) {
      if (!(pack.rest_m[k] > 0.0f)) continue;
      const auto ends =
          named<2>(first, [&](std::size_t q) { return std::size_t{q == 0 ? pack.a[k] : pack.b[k]}; });
      const double length = (g.mesh.positions[ends[0]] - g.mesh.positions[ends[1]]).norm();
      REQUIRE(static_cast<double>(pack.rest_m[k]) == doctest::Approx(length));
      found.insert(ends), taken.insert(ends.begin(), ends.end()), ++own;
    }
    REQUIRE(taken.size() == 2 * own);
    edges += own;
  });
  CHECK(edges == g.topology.edges.size());
  CHECK(found == expected);
}

TEST_CASE(
    "schedule: each hinge of a large garment is in one pack, and the hinges of a pack share no particle") {
  const Garment g;
  const cloth::BendConstraints c = cloth::make_bend(g.mesh, g.topology, cotton(), g.particles);
  std::set<std::array<std::size_t, 4>> expected, found;
  for (const cloth::Hinge& h : g.topology.hinges)
    expected.insert(named<4>(0, [&](std::size_t q) { return std::array{h.a, h.b, h.c, h.d}[q]; }));
  std::size_t hinges = 0;
  for_each_pack(c, g.particles.count(), [&](const auto& pack, std::size_t first) {
    std::set<std::size_t> taken;
    std::size_t own = 0;
    for (std::size_t k = 0; k < cloth::kPack; ++k) {
      if (cloth::to_float(pack.k[1][k]) == 0.0f) continue;  // the slot is idle
      const auto corners = named<4>(first, [&](std::size_t q) { return std::size_t{pack.corner[q][k]}; });
      found.insert(corners), taken.insert(corners.begin(), corners.end()), ++own;
    }
    REQUIRE(taken.size() == 4 * own);
    hinges += own;
  });
  CHECK(hinges == g.topology.hinges.size());
  CHECK(found == expected);
}
