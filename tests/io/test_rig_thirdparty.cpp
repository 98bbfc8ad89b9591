// Rigs that other people made: each plays, or is refused in one sentence.
#include <doctest/doctest.h>

#include <cmath>

#include <bodice/io/rig.hpp>
#include <bodice_test/data.hpp>

#include "made_rig.hpp"

using namespace bodice;
using namespace io_test;

namespace {

struct KnownRig {
  const char* file;
  std::size_t joints, clips;  ///< 0 joints: no rig
};

/// Every clip at nine times: finite, and about as large as the body, within two of its sizes.
void check_plays(const io::RiggedBody& body) {
  const geometry::Box box = geometry::bounding_box(body.body.skin.positions);
  const double size = box.size().norm();
  for (const rig::Clip& clip : body.rig->clips) {
    CAPTURE(clip.name);
    CHECK(clip.duration_s > 0.0);
    for (int k = 0; k <= 8; ++k) {
      const auto points = posed(body.body.skin, *body.rig, clip, clip.duration_s * k / 8.0);
      const geometry::Box now = geometry::bounding_box(points);
      for (const Vec3& p : points) REQUIRE(p.allFinite());
      CHECK(now.size().norm() > 0.5 * size);
      CHECK(now.size().norm() < 1.5 * size);
      CHECK((now.center() - box.center()).norm() < 2.0 * size);
    }
  }
}

}  // namespace

TEST_CASE("third-party rigs play, and files without a skeleton are read as static bodies with one sentence") {
  for (const KnownRig& known :
       {KnownRig{"CesiumMan.glb", 21, 1}, KnownRig{"Female_Dress.fbx", 43, 11},
        KnownRig{"greenman.glb", 12, 4}, KnownRig{"posed_Female_Sitting.fbx", 0, 0},
        KnownRig{"posed_Female_Walking.fbx", 0, 0}, KnownRig{"posed_Male_Standing.fbx", 0, 0}}) {
    const auto file = bodice_test::data_file(std::string("rigs/thirdparty/") + known.file);
    if (!file) return;
    CAPTURE(known.file);
    const auto body = io::import_rigged_body({}, *file);
    REQUIRE(body.ok());
    REQUIRE(body->rig.ok() == (known.joints > 0));
    if (!body->rig) {
      CHECK(body->rig.error().message == "'" + file->string() + "': The body is not bound to a skeleton.");
      continue;
    }
    CHECK(body->rig->skeleton.joints.size() == known.joints);
    CHECK(body->rig->clips.size() == known.clips);
    check_plays(*body);
  }
}
