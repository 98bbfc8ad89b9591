// Rigs of other programs: a proxy is bound to them and plays, or the file is refused with one sentence.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <bodice/binding/poser.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/rig/skinning.hpp>
#include <bodice/tryon/judge_frame.hpp>
#include <bodice/tryon/rigged_body.hpp>
#include <bodice_test/data.hpp>

using namespace bodice;

namespace {

void check_sentence(const engine::Error& error) {
  CHECK(error.sentence().size() > 20);
  CHECK(error.sentence().find('\n') == std::string::npos);
  CHECK_FALSE(error.remedy.empty());
}

/// The proxy follows the skin through the clip by carrying alone. A capsule a bone is off by 10 mm on
/// average.
void check_plays(const tryon::PreparedBody& body, const tryon::BodyMotion& motion) {
  auto poser = binding::Poser::make(body.fit.proxy);
  REQUIRE(poser.ok());
  collision::Collider collider(body.fit.proxy);
  std::vector<rig::Affine> world(motion.rig.skeleton.joints.size()), skinning(world.size());
  geometry::TriMesh skin = body.skin.input.skin;
  for (const double share : {0.0, 0.3, 0.6, 1.0}) {
    rig::joint_matrices(motion.rig.skeleton, motion.clip, share * motion.clip.duration_s, world);
    REQUIRE(poser->pose({}, world));
    REQUIRE(collider.pose(poser->posed(), 1.0 / 60.0));
    rig::skinning_matrices(motion.rig.skeleton, world, skinning);
    rig::skin_linear(body.skin.input.skin.positions, motion.rig.weights, skinning, skin.positions);
    const geometry::MeshDistance distance({}, skin);
    const auto error = tryon::measure_proxy_error({}, collider, skin, distance, 0.03);
    CAPTURE(motion.clip.name);
    CAPTURE(share);
    CHECK(error.samples > 300);
    CHECK(error.error_m.mean < 0.0025);
  }
}

}  // namespace

TEST_CASE("third-party rigs are bound and play, or are refused with one sentence") {
  for (const std::string name : {"CesiumMan.glb", "Female_Dress.fbx", "greenman.glb", "guy.iqm"}) {
    const auto file = bodice_test::data_file("rigs/thirdparty/" + name);
    if (!file) return;
    CAPTURE(name);
    auto skin = tryon::segment_file({}, *file, {});
    CHECK(skin.ok() == (name == "CesiumMan.glb" || name == "Female_Dress.fbx"));
    if (!skin) {
      check_sentence(skin.error());
      continue;
    }
    REQUIRE(skin->rig);
    REQUIRE_FALSE(skin->rig->clips.empty());
    const auto body = tryon::fit_bound_proxy({}, std::move(skin).value(), {.measure_accuracy = false});
    REQUIRE(body.ok());
    check_plays(*body, {*body->skin.rig, body->skin.rig->clips.front()});
  }
}
