// Joints, weights and clips that are written as a rigged GLB are read back unchanged.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/io/rig.hpp>
#include <bodice_test/temp_folder.hpp>

#include "made_rig.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

/// Files keep floats: 1.2e-7 of lengths up to 2 m, through chains of four matrices.
constexpr double kRoundTrip_m = 5e-6;

/// The largest distance between vertices of the body that was read and those that were written, which repair
/// has put into another order.
double farthest(const io::ImportedMesh& read, const std::vector<Vec3>& now, const std::vector<Vec3>& then) {
  double worst = 0.0;
  for (std::size_t i = 0; i < then.size(); ++i)
    worst = std::max(worst, (now.at(read.vertex_of_input.at(i)) - then[i]).norm());
  return worst;
}

}  // namespace

TEST_CASE(
    "a rigged GLB, read back, poses the skin as the rig that was written does, at any time of each clip") {
  const TempFolder folder;
  const TriMesh skin = figure();
  const rig::Rig rig = made_rig(skin);
  const auto file = folder / "made.glb";
  REQUIRE(io::write_rigged_glb(skin, rig, file).ok());
  const auto back = io::import_rigged_body({}, file);
  REQUIRE(back.ok());
  REQUIRE(back->rig.ok());
  CHECK(back->body.unit == "m");
  REQUIRE(back->body.skin.positions.size() == skin.positions.size());
  CHECK(farthest(back->body, back->body.skin.positions, skin.positions) < kRoundTrip_m);

  const rig::Skeleton &now = back->rig->skeleton, &then = rig.skeleton;
  REQUIRE(now.joints.size() == then.joints.size());
  for (std::size_t j = 0; j < then.joints.size(); ++j) {
    const auto found = find_joint(now, then.joints[j].name);
    REQUIRE(found);
    const std::int32_t parent = now.joints[*found].parent;
    CHECK((parent < 0) == (then.joints[j].parent < 0));
    if (parent >= 0)
      CHECK(now.joints[static_cast<std::size_t>(parent)].name ==
            then.joints[static_cast<std::size_t>(then.joints[j].parent)].name);
    CHECK((now.joints[*found].bind - then.joints[j].bind).norm() < kRoundTrip_m);
  }
  REQUIRE(back->rig->clips.size() == 2);
  for (std::size_t c = 0; c < 2; ++c) {
    CHECK(back->rig->clips[c].name == rig.clips[c].name);
    CHECK(back->rig->clips[c].duration_s == doctest::Approx(rig.clips[c].duration_s));
    for (const double time : {-1.0, 0.0, 0.3, 0.75, 0.999, 1.001, 1.7, 2.0, 5.0}) {
      CAPTURE(c);
      CAPTURE(time);
      CHECK(farthest(back->body, posed(back->body.skin, *back->rig, back->rig->clips[c], time),
                     posed(skin, rig, rig.clips[c], time)) < kRoundTrip_m);
    }
  }
}

TEST_CASE("a rigged GLB of a rig that does not fit its skin is refused, and nothing is written") {
  const TempFolder folder;
  const TriMesh skin = figure();
  const auto file = folder / "bad.glb";
  const auto refused = [&](const rig::Rig& rig, const char* part) {
    const auto written = io::write_rigged_glb(skin, rig, file);
    REQUIRE(!written.ok());
    CHECK(written.error().message.find(part) != std::string::npos);
    CHECK(!std::filesystem::exists(file));
  };
  rig::Rig rig = made_rig(skin);
  rig.weights.first.pop_back();
  refused(rig, "vertices");
  rig = made_rig(skin);
  rig.weights.weight[0] = 0.25f;
  refused(rig, "add up");
  rig = made_rig(skin);
  rig.skeleton.joints[1].local.scale.x() = 0.0;
  refused(rig, "'low'");
  rig = made_rig(skin);
  rig.clips[0].tracks[0].joint = 77;
  refused(rig, "joint 77");
}

TEST_CASE("a clip that goes on after its last key keeps its duration and its poses in a GLB") {
  const TempFolder folder;
  const TriMesh skin = figure();
  rig::Rig rig = made_rig(skin);
  for (rig::Clip& clip : rig.clips) clip.duration_s += 0.75;
  rig.clips.push_back({.name = "still", .duration_s = 0.5, .tracks = {}});
  const auto file = folder / "longer.glb";
  REQUIRE(io::write_rigged_glb(skin, rig, file).ok());
  const auto back = io::import_rigged_body({}, file);
  REQUIRE(back.ok());
  REQUIRE(back->rig.ok());
  REQUIRE(back->rig->clips.size() == rig.clips.size());
  for (std::size_t c = 0; c < rig.clips.size(); ++c) {
    CAPTURE(c);
    const double duration_s = rig.clips[c].duration_s;
    CHECK(back->rig->clips[c].duration_s == doctest::Approx(duration_s));
    for (const double time : {0.3, duration_s - 0.4, duration_s - 0.2, duration_s})
      CHECK(farthest(back->body, posed(back->body.skin, *back->rig, back->rig->clips[c], time),
                     posed(skin, rig, rig.clips[c], time)) < kRoundTrip_m);
  }
}
