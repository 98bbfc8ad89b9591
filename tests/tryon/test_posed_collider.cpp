// Colliders of real rigged bodies in the poses of clips, against the scalar reference.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include <bodice/binding/poser.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/rig/rig.hpp>
#include <bodice/tryon/rigged_body.hpp>
#include <bodice_test/data.hpp>
#include <bodice_test/posed_collider.hpp>

using namespace bodice;

namespace {

/// The time of each motion at which limbs are bent most.
struct Moment {
  const char* motion;
  double time_s;
};

}  // namespace

TEST_CASE(
    "colliders of real rigs that walk, sit, squat and raise their arms have the distances and owners of the "
    "reference, on every instruction set") {
  const engine::Context context;
  // In every pose the same dozen points in front of one flat ellipsoid have a buried owner to first order. So
  // the rate over both bodies varies less than that of each pose.
  constexpr std::size_t kPoints = 3000;
  std::size_t evaluated = 0;
  int buried_to_first_order = 0;
  for (const std::string name : {"f_avg_walk", "m_avg_reach"}) {
    CAPTURE(name);
    const auto file = bodice_test::data_file("rigs/" + name + ".glb");
    if (!file) continue;
    auto skin = tryon::segment_file(context, *file, {});
    REQUIRE_MESSAGE(skin.ok(), skin.error().sentence());
    fitting::FitOptions options;
    options.measure_accuracy = false;
    auto body = tryon::fit_bound_proxy(context, std::move(skin).value(), options);
    REQUIRE_MESSAGE(body.ok(), body.error().sentence());
    auto poser = binding::Poser::make(body->fit.proxy);
    REQUIRE(poser.ok());
    collision::Collider collider(body->fit.proxy);
    geometry::TriMesh posed = body->skin.input.skin;
    int buried = 0;
    for (const Moment& moment :
         {Moment{"walk", 0.3}, Moment{"sit", 2.5}, Moment{"squat", 1.5}, Moment{"arms-up", 1.5}}) {
      CAPTURE(std::string(moment.motion));
      std::vector<engine::Warning> warnings;
      auto motion = tryon::find_motion(context, body->skin, {.motion = moment.motion}, warnings);
      REQUIRE_MESSAGE(motion.ok(), motion.error().sentence());
      std::vector<rig::Affine> joints(motion->rig.skeleton.joints.size()), skinning(joints.size());
      tryon::MotionPlayer(*motion, 0.0).joints(moment.time_s, joints);
      rig::skinning_matrices(motion->rig.skeleton, joints, skinning);
      rig::skin_linear(context, body->skin.input.skin.positions, motion->rig.weights, skinning,
                       posed.positions);
      REQUIRE(poser->pose(context, joints).ok());
      REQUIRE(collider.pose(poser->posed(), 0.0));
      auto points = bodice_test::reference_at(body->fit.proxy, poser->posed(), collider,
                                              bodice_test::points_around(posed, kPoints, 31));
      buried += points.buried;
      buried_to_first_order += bodice_test::check_posed_collider(collider, points);
      evaluated += kPoints;
    }
    CHECK(buried > 100);  // otherwise the poses would not test burial
  }
  CHECK(buried_to_first_order <= static_cast<int>(evaluated * 4 / 1000));
}
