// Which tables a pose writes anew, and which it leaves as they are at rest.
#include <cstring>

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "moving_body.hpp"

using namespace bodice;
using namespace binding_test;
using geometry::Vec3;

TEST_CASE("tables of ellipsoids in the box are those of the whole pose, others those at rest") {
  const MovingBody& moving = moving_body();
  const Pose pose = march(moving.body.skeleton);
  // What comes into either counts; a box far away adds nothing.
  const geometry::Box box{Vec3(-1.0, 0.6, -1.0), Vec3(1.0, 1.0, 1.0)};
  const geometry::Box boxes[] = {{Vec3::Constant(9.0), Vec3::Constant(10.0)}, box};
  binding::Poser whole = make_poser(moving), part = make_poser(moving);
  REQUIRE(whole.pose({}, pose));
  REQUIRE(part.pose({}, seat(moving.body.skeleton)));  // what an earlier pose wrote must not stay
  REQUIRE(part.pose({}, seat(moving.body.skeleton)));
  REQUIRE(part.pose({}, pose, {.tables = true, .within = boxes}));
  std::size_t inside = 0, outside = 0;
  for (std::size_t k = 0; k < whole.posed().shapes.size(); ++k) {
    const proxy::ReliefTable& table = moving.bound.relief()[k];
    const std::size_t bytes =
        std::size_t{table.nodes_per_side} * table.nodes_per_side * sizeof(proxy::ReliefTexel);
    const auto same = [&](const proxy::ReliefTexel* texels) {
      return std::memcmp(&part.posed().texels[table.first_texel], texels + table.first_texel, bytes) == 0;
    };
    const geometry::Box reach = geometry::bounding_box(whole.posed().shapes[k]);
    const bool overlaps =
        (reach.low.array() <= box.high.array()).all() && (box.low.array() <= reach.high.array()).all();
    CAPTURE(k);
    if (overlaps)
      CHECK(same(whole.posed().texels.data()));
    else
      CHECK(same(moving.bound.texels().data()));
    inside += overlaps, outside += !overlaps;
  }
  CHECK(inside > 10);
  CHECK(outside > 10);
}

TEST_CASE(
    "where the joints of an ellipsoid move as one its table is that of rest, and follows where they do not") {
  const MovingBody& moving = moving_body();
  const rig::Skeleton& skeleton = moving.body.skeleton;
  binding::Poser poser = make_poser(moving);
  const Pose lifted = turned(skeleton, {{"thigh_l", {Vec3::UnitX(), -40.0}}});
  const JointMatrix elsewhere =
      rig::affine(1.1 * Eigen::AngleAxisd(0.5, Vec3::UnitY()).toRotationMatrix(), Vec3(0.3, 0.0, 0.1));
  // Tables of an earlier pose must not stay in either buffer.
  REQUIRE(poser.pose({}, seat(skeleton)));
  REQUIRE(poser.pose({}, march(skeleton)));
  REQUIRE(poser.pose({}, moved(elsewhere, lifted)));
  const proxy::Binding& binding = *moving.bound.binding();
  const auto turned_joint = *rig::find_joint(skeleton, "thigh_l");
  const auto below = [&](std::size_t joint) {
    for (auto j = static_cast<std::int32_t>(joint); j >= 0;
         j = skeleton.joints[static_cast<std::size_t>(j)].parent)
      if (static_cast<std::size_t>(j) == turned_joint) return true;
    return false;
  };
  int at_rest = 0, following = 0;
  for (std::size_t k = 0; k < moving.bound.ellipsoids().size(); ++k) {
    if (binding.first_bundle[k] == binding.first_bundle[k + 1]) continue;
    std::size_t terms_below = 0;
    for (std::size_t i = binding.first_term[k]; i < binding.first_term[k + 1]; ++i)
      terms_below += below(binding.terms[i].joint);
    const bool as_one = terms_below == 0 || terms_below == binding.first_term[k + 1] - binding.first_term[k];
    const proxy::ReliefTable& table = moving.bound.relief()[k];
    const std::size_t bytes =
        std::size_t{table.nodes_per_side} * table.nodes_per_side * sizeof(proxy::ReliefTexel);
    CAPTURE(k);
    const bool same = std::memcmp(&poser.posed().texels[table.first_texel],
                                  &moving.bound.texels()[table.first_texel], bytes) == 0;
    if (as_one) CHECK(same);
    at_rest += as_one;
    following += !as_one && !same;
  }
  CHECK(at_rest > 20);
  CHECK(following > 5);
}
