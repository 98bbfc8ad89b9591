// The optional real bodies, with what is known of each.
#include <doctest/doctest.h>

#include <filesystem>

#include <bodice/io/import.hpp>
#include <bodice_test/data.hpp>

using namespace bodice;

namespace {

struct KnownMesh {
  const char* file;
  const char* mesh;
  const char* unit;
  geometry::Axis up;
  std::size_t vertices;
  double volume_l;  // 0: unknown
};

constexpr KnownMesh kBodies[] = {
    {"bodies/f_avg_rest.obj", "f_avg_rest", "m", geometry::Axis::kY, 13380, 49.6},
    {"bodies/f_avg_tpose.obj", "f_avg_tpose", "m", geometry::Axis::kY, 13380, 50.1},
    {"bodies/f_avg_sit01.obj", "f_avg_sit01", "m", geometry::Axis::kY, 13380, 46.5},
    {"bodies/m_old_heavy_sit01.obj", "m_old_heavy_sit01", "m", geometry::Axis::kY, 13380, 88.6},
    {"bodies/m_avg_stride.obj", "m_avg_stride", "m", geometry::Axis::kY, 13380, 64.7},
    {"awkward/f_avg_zup_cm.obj", "f_avg_zup_cm", "cm", geometry::Axis::kZ, 3000, 49.5},
    {"awkward/f_avg_far_origin.obj", "f_avg_far_origin", "m", geometry::Axis::kY, 3000, 49.5},
    {"awkward/f_avg_inverted.obj", "f_avg_inverted", "m", geometry::Axis::kY, 3000, 49.5},
    {"awkward/f_avg_mixed_winding.obj", "f_avg_mixed_winding", "m", geometry::Axis::kY, 3000, 49.5},
    {"awkward/f_avg_soup.stl", "f_avg_soup", "m", geometry::Axis::kY, 3000, 49.5},
    {"awkward/m_avg_as_exported_dm.obj", "body", "dm", geometry::Axis::kY, 13380, 65.3},
    {"awkward/makehuman_base_raw_dm_helpers.obj", "body", "dm", geometry::Axis::kY, 13380, 0},
    {"rigs/f_avg_walk.glb", "body", "m", geometry::Axis::kY, 13380, 49.6},
    {"rigs/thirdparty/CesiumMan.glb", "Cesium_Man", "m", geometry::Axis::kY, 2338, 0},
    {"rigs/thirdparty/posed_Female_Walking.fbx", "Cylinder.010", "unknown", geometry::Axis::kY, 680, 0},
};

}  // namespace

TEST_CASE("real bodies are imported with their known unit, size and volume") {
  for (const KnownMesh& known : kBodies) {
    const auto file = bodice_test::data_file(known.file);
    if (!file) continue;
    CAPTURE(known.file);
    const auto result = io::import_body({}, *file);
    REQUIRE(result.ok());
    CHECK(result->mesh == known.mesh);
    if (known.unit) CHECK(result->unit == known.unit);
    CHECK(result->frame.up == known.up);
    if (known.vertices) CHECK(result->skin.positions.size() == known.vertices);
    if (known.volume_l > 0.0)
      CHECK(1e3 * signed_volume(result->skin) == doctest::Approx(known.volume_l).epsilon(0.01));
  }
}

TEST_CASE("Debian's human is found between its eyes and its body") {
  const std::filesystem::path file = "/usr/share/assimp/models/Collada/human.zae";
  if (!std::filesystem::exists(file)) {
    MESSAGE("skipped: package assimp-testmodels is not installed");
    return;
  }
  const auto result = io::import_body({}, file);
  REQUIRE(result.ok());
  CHECK(result->mesh == "human-baseMesh");
  CHECK(result->skin.positions.size() == 13380);
  CHECK(result->repair.boundary_edges == 0);
}
