// Made scans: what each kind promises, counted from its triangles and compared with the clean body.
#include <doctest/doctest.h>

#include <algorithm>
#include <tuple>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/synth/scan.hpp>
#include <bodice_test/share_near.hpp>

using namespace bodice;
using geometry::TriMesh;
using geometry::Vec3;
using synth::ScanKind;

namespace {

/// All meshes of a scan as one, in meters, y up.
TriMesh inside(const synth::Scan& scan) {
  TriMesh all;
  for (const synth::ScanMesh& mesh : scan.meshes) {
    const auto first = static_cast<geometry::Index>(all.positions.size());
    for (const Vec3& p : mesh.shape.positions) all.positions.push_back(scan.frame.to_inside(p));
    for (const auto& t : mesh.shape.triangles)
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

/// Shares of area: of the scan within a distance of the clean body, and of the body within it of the scan.
struct Match {
  double scan_on_body = 0.0, body_in_scan = 0.0;
};

Match match(const synth::Scan& scan, double within_m) {
  const TriMesh all = inside(scan);
  return {bodice_test::share_near(all, scan.persons[0].body, within_m),
          bodice_test::share_near(scan.persons[0].body, all, within_m)};
}

synth::Scan made(ScanKind kind, std::uint64_t seed = 1) {
  auto scan = synth::make_scan({}, kind, seed);
  REQUIRE(scan.ok());
  return std::move(*scan);
}

}  // namespace

TEST_CASE("a booth misses a part of the skin and lies within its noise elsewhere, few cameras miss more") {
  const Match booth = match(made(ScanKind::kBooth), 0.01), few = match(made(ScanKind::kFewCameras), 0.01);
  CHECK(booth.scan_on_body > 0.97);
  CHECK(booth.body_in_scan > 0.85);
  CHECK(booth.body_in_scan < 1.0);
  CHECK(few.body_in_scan < booth.body_in_scan);
}

TEST_CASE("fused kinds are closed surfaces around the body, and what is added lies elsewhere") {
  const synth::Scan fused = made(ScanKind::kFused);
  const TriMesh skin = inside(fused);
  CHECK(geometry::mesh_edges(skin).boundary == 0);
  CHECK(signed_volume(skin) > 0.0);
  CHECK(match(fused, 0.012).scan_on_body > 0.99);
  CHECK(match(made(ScanKind::kChairFused), 0.02).scan_on_body < 0.9);
  CHECK(match(made(ScanKind::kFloorJoined), 0.02).scan_on_body < 0.7);
}

TEST_CASE("two people are two pieces apart, and one piece where they are fused") {
  for (const ScanKind kind : {ScanKind::kTwoApart, ScanKind::kTwoFused}) {
    const synth::Scan scan = made(kind);
    CHECK(scan.persons.size() == 2);
    auto pieces = geometry::connected_components(inside(scan)).area;
    const auto large =
        std::count_if(pieces.begin(), pieces.end(), [&](double area) { return area > 0.1 * pieces.front(); });
    CHECK(large == (kind == ScanKind::kTwoApart ? 2 : 1));
  }
}

TEST_CASE("a scan repeats to the bit, and another seed gives another body, unit or position") {
  const synth::Scan one = made(ScanKind::kPieces, 3), same = made(ScanKind::kPieces, 3),
                    other = made(ScanKind::kPieces, 4);
  REQUIRE(one.meshes.size() == same.meshes.size());
  for (std::size_t m = 0; m < one.meshes.size(); ++m)
    CHECK(one.meshes[m].shape.positions == same.meshes[m].shape.positions);
  CHECK(one.meshes[0].shape.positions != other.meshes[0].shape.positions);
}

TEST_CASE("noise leaves the triangles, and moves vertices by its strength") {
  for (const auto& [kind, least_m, most_m] :
       {std::tuple(ScanKind::kNoise, 0.0010, 0.0014), std::tuple(ScanKind::kStrongNoise, 0.0035, 0.0055)}) {
    const synth::Scan scan = made(kind);
    const TriMesh rough = inside(scan), &clean = scan.persons[0].body;
    REQUIRE(rough.triangles == clean.triangles);
    double sum = 0.0;
    for (std::size_t v = 0; v < clean.positions.size(); ++v)
      sum += (rough.positions[v] - clean.positions[v]).norm();
    const double mean = sum / static_cast<double>(clean.positions.size());
    CHECK(mean > least_m);
    CHECK(mean < most_m);
  }
}
