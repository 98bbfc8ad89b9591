// The files of a body beside its proxy: the segmentation of its vertices and the error map.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <bodice/io/obj.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/tryon/error_map.hpp>
#include <bodice/tryon/segmentation.hpp>
#include <bodice_test/temp_folder.hpp>
#include <nlohmann/json.hpp>

#include "builtin.hpp"

using namespace bodice;
using bodice_test::TempFolder;
using geometry::Vec3;

TEST_CASE("a segmentation lists every vertex of the file once: by its region, or as internal") {
  const tryon::SegmentedSkin& skin = builtin_skin(3000);
  std::vector<Vec3> vertices;
  for (const Vec3& p : skin.input.skin.positions) vertices.push_back(skin.input.frame.to_file(p));
  const std::size_t count = vertices.size();
  Vec3 middle = Vec3::Zero();
  std::size_t heads = 0;
  for (std::size_t v = 0; v < count; ++v)
    if (skin.anatomy.part[v] == body::Part::kHead) middle += skin.input.skin.positions[v], ++heads;
  vertices.push_back(skin.input.frame.to_file(middle / static_cast<double>(heads)));  // an eye, say
  const auto lists = nlohmann::json::parse(tryon::segmentation_json({}, skin, vertices));
  std::set<std::size_t> seen;
  for (const auto& [name, list] : lists.items())
    for (const auto& v : list) CHECK(seen.insert(v.get<std::size_t>()).second);
  CHECK(lists.size() == 6);
  CHECK(seen.size() == vertices.size());
  CHECK(lists["face_internal"] == nlohmann::json({count}));
  using enum body::Part;
  const std::pair<const char*, std::set<body::Part>> regions[] = {{"left_arm", {kUpperArmL, kForearmL}},
                                                                  {"right_arm", {kUpperArmR, kForearmR}},
                                                                  {"left_leg", {kThighL, kCalfL}},
                                                                  {"right_leg", {kThighR, kCalfR}}};
  for (const auto& [name, parts] : regions) {
    std::set<std::size_t> listed, truth;
    for (const auto& v : lists[name]) listed.insert(v.get<std::size_t>());
    for (std::size_t v = 0; v < count; ++v)
      if (parts.contains(skin.anatomy.part[v])) truth.insert(v);
    CHECK(!truth.empty());
    CHECK(listed == truth);
  }
}

TEST_CASE("an error map has exact distances, and its colors end where 98 % of the vertices have less error") {
  const tryon::PreparedBody& body = builtin_body(3000, proxy::Tier::kSolid);
  const tryon::ErrorMap map = tryon::error_map({}, body);
  const std::vector<Vec3>& points = body.skin.input.skin.positions;
  REQUIRE(map.error_m.size() == points.size());
  REQUIRE(map.colors.size() == points.size());
  std::size_t beyond = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (v % 50 == 0) {
      double least = 1e9;
      for (const auto& e : body.fit.proxy.ellipsoids())
        least = std::min(least, geometry::closest_point(e.shape, points[v]).signed_distance);
      CHECK(map.error_m[v] == doctest::Approx(least - body.fit.proxy.margin_m()).epsilon(1e-9));
    }
    beyond += std::abs(map.error_m[v]) > 1.5 * map.limit_m;
    const auto& c = map.colors[v];
    if (map.error_m[v] < -0.1 * map.limit_m) CHECK(c[2] > c[0]);
    if (map.error_m[v] > 0.1 * map.limit_m) CHECK(c[0] > c[2]);
  }
  CHECK(beyond < 0.02 * static_cast<double>(points.size()));
  CHECK(map.limit_m > 0.001);
}

TEST_CASE("positions of an OBJ are read line by line; an invalid one is refused with its line number") {
  const TempFolder folder;
  const auto write = [&](const char* text) { std::ofstream(folder / "a.obj") << text; };
  write("# head\nv 1 2.5 -3e-2\nvn 0 0 1\nvt 0 1\nv  4\t5 6 0.5 0.5 0.5\r\nf 1 2 1\nv +7 8 9\n");
  const auto read = io::read_obj_positions(folder / "a.obj");
  REQUIRE(read.ok());
  CHECK(*read == std::vector<Vec3>{{1, 2.5, -3e-2}, {4, 5, 6}, {7, 8, 9}});
  write("v 1 2 3\nv 1 two 3\n");
  const auto refused = io::read_obj_positions(folder / "a.obj");
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().message.find("line 2") != std::string::npos);
  write("ply\n");
  CHECK_FALSE(io::read_obj_positions(folder / "a.obj").ok());
  CHECK(io::read_obj_positions(folder / "none.obj").error().code == engine::ErrorCode::kNotFound);
}
