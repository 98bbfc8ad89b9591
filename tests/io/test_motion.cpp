// Motions without a skin: BVH files, and the clips of files that have a skin.
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include <bodice/io/rig.hpp>
#include <bodice/rig/retarget.hpp>
#include <bodice_test/temp_folder.hpp>

#include "made_rig.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

/// A trunk and an arm in centimeters; two frames a quarter of a second apart.
const std::string kBvh =
    "HIERARCHY\nROOT Hips\n{\n OFFSET 0 90 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
    "Yrotation\n"
    " JOINT Neck\n {\n  OFFSET 0 80 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n  End Site\n  {\n   "
    "OFFSET 0 40 0\n  }\n"
    " }\n}\nMOTION\nFrames: 2\nFrame Time: 0.25\n0 90 0 0 0 0 0 0 0\n10 95 -20 90 0 0 0 30 60\n";

Eigen::Matrix3d turn_by(double degrees, const Vec3& axis) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis).toRotationMatrix();
}

std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

void check_refused(const std::filesystem::path& file, const std::string& words) {
  CAPTURE(words);
  const auto motion = io::import_motion({}, file);
  REQUIRE(!motion.ok());
  CHECK(motion.error().message.find(file.string()) != std::string::npos);
  CHECK(motion.error().message.find(words) != std::string::npos);
  CHECK(motion.error().message.ends_with('.'));
  CHECK(!motion.error().remedy.empty());
}

}  // namespace

TEST_CASE("a BVH file gives joints in meters, and poses as the product of its channels in their order") {
  const TempFolder folder;
  const auto motion = io::import_motion({}, folder.write("turn.bvh", kBvh));
  REQUIRE(motion.ok());
  CHECK(motion->unit == "cm");
  const rig::Skeleton& skeleton = motion->skeleton;
  REQUIRE(skeleton.joints.size() == 3);
  CHECK(skeleton.joints[2].name == "Neck_end");
  REQUIRE(motion->clips.size() == 1);
  CHECK(motion->clips[0].name == "turn");
  CHECK(motion->clips[0].duration_s == 0.25);
  std::vector<rig::Affine> world(3);
  joint_matrices(skeleton, motion->clips[0], 0.25, world);
  const Eigen::Matrix3d hips = turn_by(90, Vec3::UnitZ()),
                        neck = hips * turn_by(30, Vec3::UnitX()) * turn_by(60, Vec3::UnitY());
  const Vec3 at_hips(0.1, 0.95, -0.2), at_neck = at_hips + hips * Vec3(0, 0.8, 0);
  CHECK((world[0].col(3) - at_hips).norm() < 1e-12);
  CHECK((world[1].col(3) - at_neck).norm() < 1e-12);
  CHECK((world[2].col(3) - (at_neck + neck * Vec3(0, 0.4, 0))).norm() < 1e-12);
  CHECK((rig::linear_of(world[2]) - neck).norm() < 1e-12);
}

TEST_CASE("a BVH file that stands along z is turned upright") {
  const TempFolder folder;
  std::string text = kBvh;
  for (const auto& [y, z] : {std::pair{"OFFSET 0 90 0", "OFFSET 0 0 90"},
                             {"OFFSET 0 80 0", "OFFSET 0 0 80"},
                             {"OFFSET 0 40 0", "OFFSET 0 0 40"},
                             {"JOINT Neck", "JOINT Head"}})
    text = with(text, y, z);
  const auto motion = io::import_motion({}, folder.write("z.bvh", text));
  REQUIRE(motion.ok());
  std::vector<rig::Affine> world(3);
  rest_matrices(motion->skeleton, world);
  CHECK((world[1].col(3) - Vec3(0, 1.7, 0)).norm() < 1e-12);
}

TEST_CASE("BVH files that cannot be read are refused in one sentence that names the line") {
  const TempFolder folder;
  const auto spoiled = [&](const char* name, const std::string& what, const std::string& by) {
    return folder.write(name, with(kBvh, what, by));
  };
  check_refused(folder.write("no.bvh", "Dear reader\n"), "line 1 should have HIERARCHY");
  check_refused(spoiled("a.bvh", "OFFSET 0 80 0", "OFFSET 0 x 0"), "line 8 should have three finite numbers");
  check_refused(spoiled("b.bvh", "OFFSET 0 80 0", "OFFSET 0 nan 0"), "line 8");
  check_refused(spoiled("c.bvh", "CHANNELS 3", "CHANNELS 99"), "line 9 should have a number of channels");
  check_refused(spoiled("d.bvh", "3 Zrotation", "3 Wrotation"), "line 9 should have channels such as");
  check_refused(spoiled("e.bvh", "Frames: 2", "Frames: 3"), "frame 3 of 3 is not whole");
  check_refused(spoiled("f.bvh", "Frames: 2", "Frames: 0"), "the number of frames");
  check_refused(spoiled("g.bvh", "Time: 0.25", "Time: 0"), "the time of a frame");
  check_refused(folder.write("cut.bvh", kBvh.substr(0, 60)), "line");
  check_refused(folder.write("still.bvh",
                             "HIERARCHY\nROOT a\n{\n OFFSET 0 0 0\n CHANNELS 0\n}\nMOTION\n"
                             "Frames: 1000000000\nFrame Time: 0.1\n"),
                "a joint with channels");
  std::string deep = "HIERARCHY\nROOT a\n{\n";
  for (int k = 0; k < 5000; ++k) deep += "JOINT b\n{\n";
  check_refused(folder.write("deep.bvh", deep), "too large");
  check_refused(folder / "missing.bvh", "There is no file");
}

TEST_CASE("the motion of a file with a skin is that of its rig") {
  const TempFolder folder;
  const TriMesh skin = figure();
  const rig::Rig rig = made_rig(skin);
  const auto file = folder / "made.glb";
  REQUIRE(io::write_rigged_glb(skin, rig, file).ok());
  const auto motion = io::import_motion({}, file);
  REQUIRE(motion.ok());
  const auto body = io::import_rigged_body({}, file);
  REQUIRE((body.ok() && body->rig.ok()));
  REQUIRE(motion->skeleton.joints.size() == body->rig->skeleton.joints.size());
  std::vector<rig::Affine> a(motion->skeleton.joints.size()), b(a.size());
  joint_matrices(motion->skeleton, motion->clips.at(0), 0.8, a);
  joint_matrices(body->rig->skeleton, body->rig->clips.at(0), 0.8, b);
  for (std::size_t j = 0; j < a.size(); ++j) CHECK((a[j] - b[j]).norm() < 1e-9);
}

TEST_CASE("a file without a clip is no motion") {
  const TempFolder folder;
  check_refused(folder.write("still.gltf", to_gltf(figure(), "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]")),
                "holds no clip");
}
