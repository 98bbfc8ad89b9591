// Poses from float matrices of the host: chains of bones drift, and are taken; what cannot be is named.
#include <algorithm>

#include <Eigen/Geometry>

#include <bodice/binding/poser.hpp>

#include "capi/arm.hpp"
#include "capi/scene.hpp"

using namespace capi_test;

namespace {

/// The product of `depth` float quaternions and offsets, as a chain of bones makes it, 12 floats by rows.
std::vector<float> chained(bodice::engine::Random& random, int depth, float scale) {
  Eigen::Matrix3f linear = Eigen::Matrix3f::Identity();
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();
  for (int i = 0; i < depth; ++i) {
    const bodice_test::Vec3 axis = bodice_test::random_direction(random);
    const Eigen::Quaternionf turn(
        Eigen::AngleAxisf(static_cast<float>(random.uniform(0.0, 0.3)), axis.cast<float>()));
    shift += linear * Eigen::Vector3f(0.0f, 0.02f, 0.0f);
    linear = (linear * turn.toRotationMatrix()).eval();
  }
  linear *= scale;
  std::vector<float> rows;
  for (int r = 0; r < 3; ++r) rows.insert(rows.end(), {linear(r, 0), linear(r, 1), linear(r, 2), shift[r]});
  return rows;
}

bodice_pose pose_of(const std::vector<float>& matrices, std::size_t count) {
  bodice_pose pose = bodice_default_pose();
  pose.matrices = matrices.data();
  pose.count = static_cast<std::uint32_t>(count);
  pose.dt_s = 1.0 / 60.0;
  return pose;
}

}  // namespace

TEST_CASE(
    "capi: float chains of 40 bones with a scale move ellipsoids to where the exact matrices have them") {
  Scene scene(limb_proxy(false));
  bodice::engine::Random random(3);
  for (const int depth : {1, 6, 20, 40}) {
    CAPTURE(depth);
    std::vector<float> matrices;
    std::vector<bodice_test::Ellipsoid> truth = bodice_test::limb();
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const float scale = k % 2 ? 1.05f : 1.0f;
      const std::vector<float> one = chained(random, depth, scale);
      matrices.insert(matrices.end(), one.begin(), one.end());
      bodice_test::Mat3 linear;
      bodice_test::Vec3 shift;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) linear(r, c) = double{one[static_cast<std::size_t>(4 * r + c)]};
        shift[r] = double{one[static_cast<std::size_t>(4 * r + 3)]};
      }
      const Eigen::JacobiSVD<bodice_test::Mat3> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
      truth[k].center = linear * truth[k].center + shift;
      truth[k].axes = svd.matrixU() * svd.matrixV().transpose() * truth[k].axes;
      truth[k].radii *= std::cbrt(linear.determinant());
    }
    const bodice_pose pose = pose_of(matrices, truth.size());
    REQUIRE_MESSAGE(bodice_collider_move(scene.collider.get(), &pose) == BODICE_OK, bodice_last_error());
    std::vector<bodice_test::Vec3> world;
    for (int i = 0; i < 200; ++i) world.push_back(bodice_test::random_vector(random, 0.6));
    const auto found = contacts_at(scene, world);
    double worst = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double exact = bodice_test::brute_force(truth, world[i]).signed_distance;
      worst = std::max(worst, std::abs(exact - double{found[i].distance}));
    }
    CHECK(worst < 2e-6);
  }
}

TEST_CASE("capi: a matrix that cannot be is named with its reason, and nothing moves") {
  Scene scene(limb_proxy(false));
  const std::vector<bodice_test::Vec3> world = {{0.1, 0.1, 0.0}};
  const float before = contacts_at(scene, world)[0].distance;
  std::vector<float> good;
  for (int k = 0; k < 9; ++k) good.insert(good.end(), {1, 0, 0, 0.01f, 0, 1, 0, 0, 0, 0, 1, 0});
  const auto refused = [&](std::size_t at, float value, const char* reason) {
    std::vector<float> bad = good;
    bad[12 * 5 + at] = value;
    const bodice_pose pose = pose_of(bad, 9);
    CHECK(bodice_collider_move(scene.collider.get(), &pose) == BODICE_INVALID_ARGUMENT);
    const std::string sentence = bodice_last_error();
    CAPTURE(sentence);
    CHECK(sentence.find("ellipsoid 5 ") != std::string::npos);
    CHECK(sentence.find(reason) != std::string::npos);
    CHECK(contacts_at(scene, world)[0].distance == before);
  };
  refused(3, std::numeric_limits<float>::quiet_NaN(), "is not finite");
  refused(0, -1.0f, "mirrors");
  refused(0, 0.0f, "is flat");
  refused(1, 0.01f, "shears");
  refused(0, 1.01f, "shears, or scales its axes unlike");
  bodice_pose pose = pose_of(good, 8);
  CHECK(bodice_collider_move(scene.collider.get(), &pose) == BODICE_INVALID_ARGUMENT);
  CHECK(std::string(bodice_last_error()).find("8 matrices, there are 9 ellipsoids") != std::string::npos);
  pose = pose_of(good, 9);
  pose.layout = 9;
  CHECK(bodice_collider_move(scene.collider.get(), &pose) == BODICE_INVALID_ARGUMENT);
  // An entry off by a thousandth is mended, as bodice_collider_pose() mends it.
  std::vector<float> drifted = good;
  drifted[12 * 5] = 1.001f;
  pose = pose_of(drifted, 9);
  CHECK(bodice_collider_move(scene.collider.get(), &pose) == BODICE_OK);
  pose = pose_of(good, 9);
  CHECK(bodice_collider_move(scene.collider.get(), &pose) == BODICE_OK);
  CHECK(contacts_at(scene, world)[0].distance != before);
}

TEST_CASE("capi: a bound proxy follows the bones in every form of matrix, as the engine has it") {
  const Arm arm;
  const auto bound = arm.bound();
  const Joints bent = arm.bent();
  Scene scene(bound);
  auto poser = bodice::binding::Poser::make(bound);
  REQUIRE(poser);
  bodice_proxy_info info = bodice_default_proxy_info();
  REQUIRE(bodice_proxy_get_info(scene.proxy.get(), &info) == BODICE_OK);
  REQUIRE(info.joints == 2);
  CHECK(std::string(bodice_proxy_joint_name(scene.proxy.get(), 1)) == "forearm");
  double bind[12];
  REQUIRE(bodice_proxy_get_bind(scene.proxy.get(), 0, bind) == BODICE_OK);
  CHECK(bind[7] == -0.3);

  // An ellipsoid moves with its joints as the skin at the height of its center does.
  const auto ellipsoids = bound.ellipsoids();
  for (std::uint32_t k = 0; k < ellipsoids.size(); ++k) {
    CAPTURE(k);
    std::uint16_t joint[2];
    float weight[2];
    std::size_t count = 0;
    REQUIRE(bodice_proxy_get_joint_weights(scene.proxy.get(), k, joint, weight, 2, &count) == BODICE_OK);
    REQUIRE(count <= 2);
    double of_forearm = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      sum += double{weight[i]};
      if (joint[i] == 1) of_forearm = double{weight[i]};
    }
    CHECK(sum == doctest::Approx(1.0).epsilon(1e-5));
    const double expected = std::clamp(0.5 + ellipsoids[k].shape.center.y() / 0.1, 0.01, 0.99);
    CHECK(std::abs(of_forearm - expected) < 0.1);
  }

  std::vector<float> rows, columns, columns43;
  for (const auto& m : bent) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) rows.push_back(static_cast<float>(m(r, c)));
    rows.insert(rows.end(), {7, 7});  // a stride of 14 floats
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 3; ++r) columns.push_back(static_cast<float>(m(r, c)));
      columns.push_back(c == 3 ? 1.0f : 0.0f);
      for (int r = 0; r < 3; ++r) columns43.push_back(static_cast<float>(m(r, c)));
    }
  }
  std::vector<bodice_test::Vec3> world;
  bodice::engine::Random random(4);
  REQUIRE(poser->pose({}, bent));
  for (const auto& shape : poser->posed().shapes)
    for (int i = 0; i < 20; ++i) world.push_back(shape.center + bodice_test::random_vector(random, 0.1));
  const auto at_rest = contacts_at(scene, world);
  REQUIRE(scene.engine.pose(poser->posed(), 0.0));
  const auto check = [&](const bodice_pose& pose) {
    REQUIRE_MESSAGE(bodice_collider_pose(scene.collider.get(), &pose) == BODICE_OK, bodice_last_error());
    const auto found = contacts_at(scene, world);
    std::size_t wrong = 0, moved = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      float local[3];
      for (int axis = 0; axis < 3; ++axis)
        local[axis] = static_cast<float>(world[i][axis] - scene.engine.origin()[axis]);
      wrong += std::abs(scene.engine.query(local).signed_distance - found[i].distance) > 2e-6f;
      moved += std::abs(found[i].distance - at_rest[i].distance) > 0.01f;
    }
    CHECK(wrong == 0);
    CHECK(moved > found.size() / 2);
  };
  bodice_pose pose = pose_of(rows, 2);
  pose.stride = 14 * sizeof(float);
  check(pose);
  pose = pose_of(columns, 2);
  pose.layout = BODICE_COLUMNS_4X4;
  check(pose);
  pose = pose_of(columns43, 2);
  pose.layout = BODICE_COLUMNS_3X4;
  check(pose);

  columns[16] = -columns[16];  // the forearm mirrored along x
  pose = pose_of(columns, 2);
  pose.layout = BODICE_COLUMNS_4X4;
  CHECK(bodice_collider_pose(scene.collider.get(), &pose) == BODICE_INVALID_ARGUMENT);
  CHECK(std::string(bodice_last_error()).find("forearm") != std::string::npos);
  bodice_pose move = pose_of(rows, info.ellipsoids);
  CHECK(bodice_collider_move(scene.collider.get(), &move) == BODICE_INVALID_ARGUMENT);

  if (!bodice_test::counts_allocations()) return;
  pose = pose_of(columns43, 2);
  pose.layout = BODICE_COLUMNS_3X4;
  const auto frame = [&] { REQUIRE(bodice_collider_pose(scene.collider.get(), &pose) == BODICE_OK); };
  frame();
  CHECK(bodice_test::allocations_when_warm(3, frame) == 0);
}
