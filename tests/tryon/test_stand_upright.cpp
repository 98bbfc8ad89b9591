// The up axis of files that do not state it, for bodies with extents that do not show it.
#include <doctest/doctest.h>

#include <bodice/io/obj.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/tryon/prepare.hpp>
#include <bodice_test/temp_folder.hpp>

using namespace bodice;

namespace {

/// An OBJ of a body in this pose with this axis up.
std::filesystem::path write(const bodice_test::TempFolder& folder, synth::Pose pose, geometry::Axis up) {
  auto body = synth::make_body({}, {.pose = pose, .vertices = 4000});
  REQUIRE(body.ok());
  const auto file = folder / "body.obj";
  REQUIRE(io::write_obj(body->mesh, file, {1.0, up}).ok());
  return file;
}

}  // namespace

TEST_CASE("a body that sits or stretches its arms is turned upright, whatever the axis of its file") {
  const bodice_test::TempFolder folder;
  for (const synth::Pose pose : {synth::Pose::kSit, synth::Pose::kT, synth::Pose::kA})
    for (const geometry::Axis up : {geometry::Axis::kX, geometry::Axis::kY, geometry::Axis::kZ}) {
      CAPTURE(static_cast<int>(pose));
      CAPTURE(static_cast<int>(up));
      const auto skin = tryon::segment_file({}, write(folder, pose, up), {});
      REQUIRE(skin.ok());
      CHECK(skin->input.frame.up == up);
      CHECK(skin->anatomy.up.y() > 0.9);
      const auto at = [&](body::LandmarkId id) {
        return skin->anatomy.landmarks[static_cast<std::size_t>(id)].position;
      };
      CHECK((at(body::LandmarkId::kCrown) - at(body::LandmarkId::kPerineum)).normalized().y() > 0.9);
      CHECK(std::abs(skin->distance->signed_distance(skin->input.skin.positions[0])) < 1e-9);
    }
}

TEST_CASE("an axis that the caller gives is kept, whatever the trunk's direction is") {
  const bodice_test::TempFolder folder;
  const auto file = write(folder, synth::Pose::kSit, geometry::Axis::kZ);
  const auto skin = tryon::segment_file({}, file, {.import = {.up = geometry::Axis::kY}});
  REQUIRE(skin.ok());
  CHECK(skin->input.frame.up == geometry::Axis::kY);
}
