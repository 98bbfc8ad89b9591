// Rigs of real bodies against the positions that another program computed from the same files.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

#include <bodice/io/rig.hpp>
#include <bodice_test/data.hpp>
#include <nlohmann/json.hpp>

using namespace bodice;
using nlohmann::json;
using rig::Vec3;

namespace {

/// The truth is written with five digits after the point.
constexpr double kTruth_m = 1e-5;

Vec3 to_vec3(const json& v) {
  return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

void check_file(const std::filesystem::path& glb, const std::filesystem::path& frames) {
  CAPTURE(glb);
  const auto imported = io::import_rigged_body({}, glb);
  REQUIRE(imported.ok());
  REQUIRE(imported->rig.ok());
  const rig::Rig& rig = *imported->rig;
  REQUIRE(rig.clips.size() == 1);
  std::ifstream stream(frames);
  const json truth = json::parse(stream);

  const geometry::TriMesh& skin = imported->body.skin;
  std::vector<rig::Affine> world(rig.skeleton.joints.size()), skinning(world.size());
  std::vector<Vec3> posed(skin.positions.size());
  for (const json& frame : truth["frames"]) {
    joint_matrices(rig.skeleton, rig.clips[0], frame["time_s"].get<double>(), world);
    skinning_matrices(rig.skeleton, world, skinning);
    skin_linear(skin.positions, rig.weights, skinning, posed);
    CAPTURE(frame["frame"].get<int>());
    double worst_joint = 0.0, worst_vertex = 0.0;
    for (const auto& [name, position] : frame["bone_positions"].items()) {
      const auto joint = find_joint(rig.skeleton, name);
      REQUIRE(joint);
      worst_joint = std::max(worst_joint, (world[*joint].col(3) - to_vec3(position)).cwiseAbs().maxCoeff());
    }
    for (std::size_t k = 0; k < truth["sample_vertices"].size(); ++k) {
      const geometry::Index v =
          imported->body.vertex_of_input[truth["sample_vertices"][k].get<std::size_t>()];
      REQUIRE(v != geometry::kNoIndex);
      worst_vertex =
          std::max(worst_vertex, (posed[v] - to_vec3(frame["sample_positions"][k])).cwiseAbs().maxCoeff());
    }
    CHECK(worst_joint <= kTruth_m);
    CHECK(worst_vertex <= kTruth_m);
  }
}

}  // namespace

TEST_CASE(
    "import of a rig: bones and skinned vertices of real bodies stand where another program puts them") {
  for (const std::string name : {"f_avg_walk", "m_avg_reach"}) {
    const auto glb = bodice_test::data_file("rigs/" + name + ".glb");
    const auto frames = bodice_test::data_file("rigs/" + name + ".frames.json");
    if (!glb || !frames) {
      MESSAGE("skipped: no real rigs");
      return;
    }
    check_file(*glb, *frames);
  }
}
