// Which vertices of a garment a body holds.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/synth/garment.hpp>
#include <bodice/tryon/wearing.hpp>

#include "builtin.hpp"

using namespace bodice;

namespace {

constexpr int kWearerVertices = 4500;

geometry::TriMesh garment_for(const tryon::SegmentedSkin& skin, synth::GarmentKind kind) {
  auto garment = tryon::make_garment({}, skin, {.kind = kind});
  REQUIRE_MESSAGE(garment.ok(), garment.error().sentence());
  return std::move(garment->mesh);
}

}  // namespace

TEST_CASE("a skirt is held at its waistband, a tunic is not held") {
  const tryon::SegmentedSkin& skin = builtin_skin(kWearerVertices);
  const geometry::TriMesh skirt = garment_for(skin, synth::GarmentKind::kSkirt);
  const auto held = tryon::held_vertices(skirt, skin);
  REQUIRE_FALSE(held.empty());
  CHECK(held.size() < skirt.positions.size() / 5);
  double lowest = 1e9;
  for (const geometry::Index v : held) lowest = std::min(lowest, skirt.positions[v].y());
  CHECK(lowest > 0.5 * skin.anatomy.stature_m);

  CHECK(tryon::held_vertices(garment_for(skin, synth::GarmentKind::kTunic), skin).empty());
}

TEST_CASE("a tunic that lies on the waistband of a skirt is not held with it") {
  const tryon::SegmentedSkin& skin = builtin_skin(kWearerVertices);
  const geometry::TriMesh skirt = garment_for(skin, synth::GarmentKind::kSkirt);
  const auto held = tryon::held_vertices(skirt, skin);
  geometry::TriMesh both = skirt;
  const auto first = static_cast<geometry::Index>(both.positions.size());
  const geometry::TriMesh tunic = garment_for(skin, synth::GarmentKind::kTunic);
  double nearest_m = 1.0;
  for (const geometry::Vec3& p : tunic.positions) {
    both.positions.push_back(p);
    for (const geometry::Index v : held) nearest_m = std::min(nearest_m, (p - skirt.positions[v]).norm());
  }
  for (const geometry::Triangle& t : tunic.triangles)
    both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  REQUIRE(nearest_m < 0.008);  // half of the height of a waistband
  CHECK(tryon::held_vertices(both, skin) == held);
}

TEST_CASE("a closed piece has no waistband and is not held") {
  const tryon::SegmentedSkin& skin = builtin_skin(kWearerVertices);
  const geometry::Vec3 hip = 0.55 * skin.anatomy.stature_m * geometry::Vec3::UnitY();
  geometry::TriMesh ball{{hip, hip, hip, hip}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  for (int corner = 0; corner < 3; ++corner)
    ball.positions[static_cast<std::size_t>(corner) + 1][corner] += 0.2;
  CHECK(tryon::held_vertices(ball, skin).empty());
}
