// What write_glb() wrote is read back as it was, in meters, y up.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include <bodice/engine/text.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/io/rig.hpp>
#include <bodice/io/scene_file.hpp>
#include <bodice_test/temp_folder.hpp>

#include "made_rig.hpp"
#include "scene_fixture.hpp"
#include "textured_tube.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

// Floats round positions of up to 2 m by less.
constexpr double kFloatsOfPositions_m = 2e-6;

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  REQUIRE(a.size() == b.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

io::SceneFile read_back(const io::Scene& scene, const TempFolder& folder) {
  const auto file = folder / "scene.glb";
  const auto written = io::write_glb(scene, file);
  REQUIRE_MESSAGE(written.ok(), (written.ok() ? std::string() : written.error().sentence()));
  auto back = io::read_scene_file({}, file);
  REQUIRE_MESSAGE(back.ok(), (back.ok() ? std::string() : back.error().sentence()));
  return std::move(back).value();
}

}  // namespace

TEST_CASE("a scene of any unit and axes comes back from its GLB in meters, y up") {
  for (const geometry::Frame& frame :
       {geometry::Frame{}, geometry::Frame{.meters_per_unit = 0.01, .up = geometry::Axis::kZ},
        geometry::Frame{.meters_per_unit = 0.0254, .up = geometry::Axis::kX}}) {
    const TempFolder folder;
    SceneFixture fixture(frame);
    std::vector<std::vector<geometry::Ellipsoid>> moves(3);
    for (std::size_t f = 0; f < 3; ++f)
      for (const proxy::ProxyEllipsoid& e : fixture.proxies.front().ellipsoids()) {
        moves[f].push_back(e.shape);
        moves[f].back().center.x() += 0.125 * static_cast<double>(f);
      }
    fixture.scene.proxy_frames = moves;
    const io::SceneFile back = read_back(fixture.scene, folder);
    CHECK(farthest(back.body.positions, fixture.body.positions) < kFloatsOfPositions_m);
    CHECK(back.body.triangles == fixture.body.triangles);
    CHECK(back.part == fixture.part);
    CHECK(back.body_frames.empty());
    CHECK(back.proxy_hash == engine::hex64(fixture.proxies.front().hash()));
    REQUIRE(back.ellipsoids.size() == 2);
    REQUIRE(back.ellipsoid_frames.size() == 3);
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(back.ellipsoids[k].part == fixture.proxies.front().ellipsoids()[k].part);
      for (std::size_t f = 0; f < 3; ++f) {
        const geometry::Ellipsoid &now = back.ellipsoid_frames[f][k], &then = moves[f][k];
        CHECK((now.center - then.center).norm() < kFloatsOfPositions_m);
        const auto moment = [](const geometry::Ellipsoid& e) {
          return geometry::Mat3(e.axes * e.radii.cwiseAbs2().asDiagonal() * e.axes.transpose());
        };
        CHECK((moment(now) - moment(then)).norm() < kFloatsOfPositions_m);
      }
    }
    REQUIRE(back.garments.size() == 1);
    const io::GarmentTrack &now = back.garments[0], &then = fixture.scene.garments[0];
    CHECK(now.mesh.triangles == then.mesh.triangles);
    CHECK(now.time_s == then.time_s);
    REQUIRE(now.frames.size() == then.frames.size());
    for (std::size_t f = 0; f < then.frames.size(); ++f)
      CHECK(farthest(now.frames[f], then.frames[f]) < kFloatsOfPositions_m);
  }
}

TEST_CASE("frames that take many bytes come back from small integers within half a step") {
  const TempFolder folder;
  SceneFixture fixture;
  io::GarmentTrack& track = fixture.scene.garments[0];
  track.mesh = bodice_test::cylinder(0.35, 0.6, 200, 40, false);
  const std::vector<Vec3> first = track.mesh.positions;
  track.frames.clear(), track.time_s.clear();
  const std::size_t count = (std::size_t{9} << 20) / (24 * first.size());
  for (std::size_t f = 0; f < count; ++f) {
    track.frames.push_back(first);
    const double time = static_cast<double>(f) / 30.0;
    for (std::size_t v = 0; v < first.size() / 2; ++v)  // the others do not move
      track.frames.back()[v] += Vec3(0.7 * std::sin(time), 0.1 * time * first[v].y(), 0.0);
    track.time_s.push_back(time);
  }
  fixture.scene.proxy_frames = {};
  const io::SceneFile back = read_back(fixture.scene, folder);
  REQUIRE(back.garments.size() == 1);
  REQUIRE(back.garments[0].frames.size() == count);
  double worst = 0.0;
  for (std::size_t f = 0; f < count; ++f)
    worst = std::max(worst, farthest(back.garments[0].frames[f], track.frames[f]));
  CHECK(worst < std::sqrt(3.0) / 65534.0 + kFloatsOfPositions_m);  // displacements below 1 m
  CHECK(worst > 1e-6);                                             // floats would be nearer
  CHECK(std::filesystem::file_size(folder / "scene.glb") < 8 * count * first.size() / 2 + 60 * first.size());
}

TEST_CASE("a skinned body comes back at the times of its garments as the rig poses it") {
  const TempFolder folder;
  SceneFixture fixture;
  const rig::Rig rig = made_rig(fixture.body);
  fixture.scene.rig = &rig;
  fixture.scene.part = {};
  fixture.scene.proxy = nullptr;
  const io::SceneFile back = read_back(fixture.scene, folder);
  CHECK(farthest(back.body.positions, fixture.body.positions) < kFloatsOfPositions_m);
  CHECK(back.part.empty());
  const std::vector<double>& times = fixture.scene.garments[0].time_s;
  REQUIRE(back.body_frames.size() == times.size());
  std::vector<rig::Affine> world(rig.skeleton.joints.size()), skinning(world.size());
  std::vector<Vec3> posed(fixture.body.positions.size());
  for (std::size_t f = 0; f < times.size(); ++f) {
    rig::joint_matrices(rig.skeleton, rig.clips.front(), times[f], world);
    rig::skinning_matrices(rig.skeleton, world, skinning);
    rig::skin_linear(fixture.body.positions, rig.weights, skinning, posed);
    CHECK(farthest(back.body_frames[f], posed) < 5e-6);
  }
}

TEST_CASE("garments with the names of other nodes are read back as themselves") {
  const TempFolder folder;
  io::Scene scene;
  const TriMesh body = figure();
  scene.body = &body;
  std::size_t vertices = 0;
  for (const char* name : {"cloth_2", "body"}) {
    std::string obj = Tube().obj();
    obj.replace(obj.find("o Tube"), 6, "o "s + name);
    io::GarmentTrack& track = scene.garments.emplace_back();
    const io::ImportedMesh garment = imported(folder.write("tube.obj", obj));
    track.name = scene.garments.size() == 1 ? "cloth" : "cloth_2";
    track.mesh = garment.skin;
    track.look = garment.look;
    for (Vec3& p : track.mesh.positions) p.x() += static_cast<double>(scene.garments.size());
    track.frames = {track.mesh.positions};
    vertices = track.mesh.positions.size();
  }
  REQUIRE(io::write_glb(scene, folder / "names.glb").ok());
  const auto back = io::read_scene_file({}, folder / "names.glb");
  REQUIRE(back.ok());
  CHECK(back->body.positions.size() == body.positions.size());
  REQUIRE(back->garments.size() == 2);
  for (std::size_t g = 0; g < 2; ++g) {
    REQUIRE(back->garments[g].mesh.positions.size() == vertices);
    CHECK((back->garments[g].frames[0][5] - scene.garments[g].frames[0][5]).norm() < 1e-6);
  }
}

TEST_CASE("a file that is no scene, or a damaged one, is refused in one sentence that names it") {
  const TempFolder folder;
  const auto refused = [&](const std::filesystem::path& file) {
    const auto back = io::read_scene_file({}, file);
    REQUIRE_FALSE(back.ok());
    CHECK(back.error().message.find(file.filename().string()) != std::string::npos);
    return back.error().code;
  };
  CHECK(refused(folder / "none.glb") == engine::ErrorCode::kNotFound);
  std::ofstream(folder / "text.glb") << "no glTF";
  CHECK(refused(folder / "text.glb") == engine::ErrorCode::kUnreadable);
  const TriMesh skin = figure();
  std::ofstream(folder / "other.gltf") << R"({"asset": {"version": "2.0"}, "nodes": [{"name": "lamp"}]})";
  CHECK(refused(folder / "other.gltf") == engine::ErrorCode::kInvalidArgument);
  const SceneFixture fixture;
  REQUIRE(io::write_glb(fixture.scene, folder / "cut.glb").ok());
  std::filesystem::resize_file(folder / "cut.glb", std::filesystem::file_size(folder / "cut.glb") / 2);
  CHECK(refused(folder / "cut.glb") == engine::ErrorCode::kUnreadable);
}
