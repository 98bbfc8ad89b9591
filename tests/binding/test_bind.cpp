#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include <doctest/doctest.h>

#include <bodice/binding/poser.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/proxy/proxy_file.hpp>
#include <bodice_test/executors.hpp>

#include "moving_body.hpp"

using namespace bodice;
using namespace binding_test;

TEST_CASE("each ellipsoid's bone is a joint that moves its part") {
  const MovingBody& moving = moving_body();
  const auto& names = moving.bound.binding()->joint_names;
  REQUIRE(names.size() == moving.body.skeleton.joints.size());
  int calves = 0;
  for (const proxy::ProxyEllipsoid& e : moving.bound.ellipsoids()) {
    REQUIRE(e.bone >= 0);
    const std::string& bone = names[static_cast<std::size_t>(e.bone)];
    if (e.part != body::Part::kCalfL) continue;
    ++calves;
    const bool below_knee = bone == "calf_l" || bone == "foot_l" || bone == "toes_l" || bone == "thigh_l";
    CHECK_MESSAGE(below_knee, bone);
  }
  CHECK(calves > 0);
}

TEST_CASE("the affine maps of a rigid motion are that motion") {
  const MovingBody& moving = moving_body();
  const proxy::Binding& binding = *moving.bound.binding();
  for (std::size_t k = 0; k + 1 < binding.first_term.size(); ++k) {
    Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
    for (std::size_t i = binding.first_term[k]; i < binding.first_term[k + 1]; ++i)
      sum += Eigen::Map<const Eigen::Matrix4d>(binding.terms[i].matrix.data());
    CHECK((sum - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("binding gives the same hash for any executor") {
  const MovingBody& moving = moving_body();
  proxy::BodyProxy::Data data = moving.bound.data();
  data.binding = nullptr;
  for (proxy::ProxyEllipsoid& e : data.ellipsoids) e.bone = proxy::kNoBone;
  const auto unbound = proxy::BodyProxy::make(std::move(data));
  REQUIRE(unbound);
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    const auto bound = binding::bind({.executor = executor.get()}, *unbound,
                                     {moving.body.mesh, moving.body.skeleton, moving.body.weights});
    REQUIRE(bound);
    CHECK(bound->hash() == moving.bound.hash());
  }
  CHECK(unbound->hash() != moving.bound.hash());
}

TEST_CASE("a bound proxy takes less than a megabyte") {
  const MovingBody& moving = moving_body();
  CHECK(moving.bound.bytes() + moving.bound.binding()->bytes() < 1'000'000);
}

TEST_CASE("both files keep a binding to the bit, and a proxy without one is written as before") {
  const MovingBody& moving = moving_body();
  const auto from_binary = proxy::from_binary(proxy::to_binary(moving.bound));
  REQUIRE(from_binary);
  CHECK(from_binary->hash() == moving.bound.hash());
  const auto from_json = proxy::from_json(proxy::to_json(moving.bound));
  REQUIRE(from_json);
  CHECK(from_json->hash() == moving.bound.hash());
  REQUIRE(from_json->binding());
  CHECK(from_json->binding()->joint_names == moving.bound.binding()->joint_names);

  proxy::BodyProxy::Data data = moving.bound.data();
  data.binding = nullptr;
  const auto unbound = proxy::BodyProxy::make(std::move(data));
  REQUIRE(unbound);
  CHECK(proxy::to_json(*unbound).find("\"version\": 2,") != std::string::npos);
  CHECK(std::to_integer<int>(proxy::to_binary(*unbound)[8]) == 2);
}

TEST_CASE("a damaged binding is refused wherever it is cut, and no index leads out of it") {
  const MovingBody& moving = moving_body();
  const std::vector<std::byte> bytes = proxy::to_binary(moving.bound);
  for (std::size_t end = 0; end < bytes.size(); end += 9973)
    CHECK_FALSE(proxy::from_binary(std::span(bytes).first(end)));
  const auto refuses = [&](auto&& change) {
    auto binding = std::make_shared<proxy::Binding>(*moving.bound.binding());
    change(*binding);
    proxy::BodyProxy::Data data = moving.bound.data();
    data.binding = binding;
    return !proxy::BodyProxy::make(std::move(data));
  };
  CHECK_FALSE(refuses([](proxy::Binding&) {}));
  CHECK(refuses([](proxy::Binding& b) { b.terms[0].joint = 60000; }));
  CHECK(refuses([](proxy::Binding& b) { b.entries[0].term = 60000; }));
  CHECK(refuses([](proxy::Binding& b) { std::ranges::fill(b.first_term, 0u), b.terms.clear(); }));
  CHECK(refuses([](proxy::Binding& b) { b.first_term[1] = 0; }));
  CHECK(refuses([](proxy::Binding& b) { b.joint_names[0].assign(65536, 'j'); }));
  CHECK(refuses([](proxy::Binding& b) { b.bundles[0].texel[3] = 65535; }));
  CHECK(refuses([](proxy::Binding& b) { b.followers[0] = 65535; }));
  CHECK(refuses([](proxy::Binding& b) { b.first_bundle[1] = 1u << 30; }));
  CHECK(refuses([](proxy::Binding& b) { b.first_entry.pop_back(); }));
  CHECK(refuses([](proxy::Binding& b) { b.burial.pop_back(); }));
  CHECK(refuses([](proxy::Binding& b) { b.bind[0](1, 1) = std::numeric_limits<double>::quiet_NaN(); }));
  CHECK(refuses([](proxy::Binding& b) { b.step_m[0] = std::numeric_limits<float>::infinity(); }));
}

TEST_CASE("a binding of random numbers is refused, or it can be posed") {
  const MovingBody& moving = moving_body();
  engine::Random random(17);
  const auto any = [&](std::size_t size) { return static_cast<std::size_t>(random.uniform() * size); };
  const auto number = [&] {  // small ones and the largest find most limits
    const std::uint32_t near[] = {0, 1, 2, 88, 255, 256, 65535, 0xffffffffu};
    return random.uniform() < 0.5 ? near[any(8)] : static_cast<std::uint32_t>(any(100000));
  };
  int posed = 0, refused = 0;
  for (int round = 0; round < 3000; ++round) {
    auto binding = std::make_shared<proxy::Binding>(*moving.bound.binding());
    proxy::Binding& b = *binding;
    switch (round % 8) {
      case 0:
        b.first_term[any(b.first_term.size())] = number();
        break;
      case 1:
        b.terms[any(b.terms.size())].joint = static_cast<std::uint16_t>(number());
        break;
      case 2:
        b.first_bundle[any(b.first_bundle.size())] = number();
        break;
      case 3:
        b.bundles[any(b.bundles.size())].texel[any(8)] = static_cast<std::uint16_t>(number());
        break;
      case 4:
        b.first_entry[any(b.first_entry.size())] = number();
        break;
      case 5:
        b.entries[any(b.entries.size())].term = static_cast<std::uint16_t>(number());
        break;
      case 6:
        b.first_follower[any(b.first_follower.size())] = number();
        break;
      default:
        b.followers[any(b.followers.size())] = static_cast<std::uint16_t>(number());
        break;
    }
    proxy::BodyProxy::Data data = moving.bound.data();
    data.binding = binding;
    const auto made = proxy::BodyProxy::make(std::move(data));
    if (!made) {
      ++refused;
      continue;
    }
    auto poser = binding::Poser::make(*made);
    REQUIRE(poser);
    if (posed++ % 20 == 0) CHECK(poser->pose(engine::Context{}, std::span<const proxy::JointMatrix>(b.bind)));
  }
  CHECK(posed > 100);
  CHECK(refused > 1000);
}

TEST_CASE("weights of another skin and a rig without joints are refused in a sentence") {
  const MovingBody& moving = moving_body();
  const rig::Skeleton none;
  const auto no_joints = binding::bind({}, moving.bound, {moving.body.mesh, none, moving.body.weights});
  REQUIRE_FALSE(no_joints);
  CHECK(no_joints.error().message == "Binding: the rig has no joints.");
  geometry::TriMesh other = moving.body.mesh;
  other.positions.push_back(geometry::Vec3::Zero());
  CHECK_FALSE(binding::bind({}, moving.bound, {other, moving.body.skeleton, moving.body.weights}));
}

TEST_CASE("a chain of a thousand joints binds and poses") {
  const MovingBody& moving = moving_body();
  rig::Skeleton chain;
  rig::SkinWeights weights;
  for (int j = 0; j < 1000; ++j) {
    rig::Joint joint;
    joint.name = "j" + std::to_string(j);
    joint.parent = j - 1;
    joint.bind.col(3) = geometry::Vec3(0.0, 0.0017 * j, 0.0);
    chain.joints.push_back(joint);
  }
  weights.first.push_back(0);
  for (const geometry::Vec3& at : moving.body.mesh.positions) {
    weights.joint.push_back(static_cast<std::uint16_t>(std::clamp(at.y() / 0.0017, 0.0, 999.0)));
    weights.weight.push_back(1.0f);
    weights.first.push_back(static_cast<std::uint32_t>(weights.joint.size()));
  }
  proxy::BodyProxy::Data data = moving.bound.data();
  data.binding = nullptr;
  const auto bound =
      binding::bind({}, *proxy::BodyProxy::make(std::move(data)), {moving.body.mesh, chain, weights});
  REQUIRE(bound);
  auto poser = binding::Poser::make(*bound);
  REQUIRE(poser);
  CHECK(poser->pose({}, bind_pose(chain)));
}
