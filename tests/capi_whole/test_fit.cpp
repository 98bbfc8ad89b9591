// Fits, now and by ticket, and proxies bound to the bones of the host.
#include <algorithm>
#include <cmath>
#include <thread>

#include <bodice/binding/bind.hpp>
#include <bodice/tryon/prepare.hpp>

#include "capi_whole/body.hpp"

using namespace capi_test;
using namespace bodice;

namespace {

/// The skeleton of a made body as the host's arrays.
struct RigArrays {
  static constexpr std::uint32_t kJoints = 8;
  std::vector<double> matrices;
  std::vector<std::int32_t> parents;
  std::vector<const char*> names;
  std::vector<std::uint16_t> joint;
  std::vector<float> weight;
  bodice_pose bind = bodice_default_pose();
  bodice_rig rig = bodice_default_rig();

  explicit RigArrays(const synth::Body& body) {
    for (const rig::Joint& j : body.skeleton.joints) {
      for (int i = 0; i < 12; ++i) matrices.push_back(j.bind(i / 4, i % 4));
      parents.push_back(j.parent);
      names.push_back(j.name.c_str());
    }
    const std::size_t vertices = body.mesh.positions.size();
    joint.resize(kJoints * vertices);
    weight.resize(kJoints * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
      const std::uint32_t first = body.weights.first[v], last = body.weights.first[v + 1];
      REQUIRE(last - first <= kJoints);
      for (std::uint32_t e = first; e < last; ++e) {
        joint[kJoints * v + e - first] = body.weights.joint[e];
        weight[kJoints * v + e - first] = body.weights.weight[e];
      }
    }
    bind.matrices = matrices.data();
    bind.count = static_cast<std::uint32_t>(parents.size());
    bind.scalar = BODICE_DOUBLE;
    rig.bind = &bind;
    rig.parents = parents.data();
    rig.names = names.data();
    rig.vertices = vertices;
    rig.joint = joint.data();
    rig.weight = weight.data();
    rig.joints_per_vertex = kJoints;
  }
};

bodice_skin_options with_rig(const bodice_rig& rig) {
  bodice_skin_options options = bodice_default_skin_options();
  options.rig = &rig;
  return options;
}

}  // namespace

TEST_CASE("capi: a fit is that of C++, for any number of workers, and its report holds") {
  MeshArrays arrays(make_body().mesh);
  std::vector<std::uint64_t> hashes;
  for (const int workers : {1, 3}) {
    const Context context = make_context(workers);
    const Skin skin = make_skin(context, arrays);
    bodice_fit_report report = bodice_default_fit_report();
    const auto proxy = skin.fit(context, solid(), &report);
    REQUIRE_MESSAGE(proxy, bodice_last_error());
    hashes.push_back(hash_of(proxy->get()));
    CHECK(report.ellipsoids > 20);
    CHECK(report.gap_mean_m > 0.0);
    CHECK(report.interior_covered > 0.95);

    // The mean gap by the exact distance of another function: from the vertices to the proxy.
    const auto collider = Collider::create(context, *proxy);
    REQUIRE(collider);
    double sum = 0.0;
    for (std::size_t v = 0; v < arrays.xyz.size(); v += 30) {
      bodice_contact contact;
      must(bodice_query_point(collider->get(), &arrays.xyz[v], &contact));
      sum += std::abs(double{contact.distance});
    }
    const double mean = sum / static_cast<double>((arrays.xyz.size() + 29) / 30);
    CHECK(mean < 2.0 * report.gap_mean_m);
    CHECK(mean > 0.3 * report.gap_mean_m);
  }
  CHECK(hashes[0] == hashes[1]);
  auto input = tryon::repair_body({}, make_body().mesh);
  auto skin = tryon::segment_mesh({}, *input, {});
  const auto expected = tryon::fit_proxy({}, std::move(*skin), {.tier = proxy::Tier::kSolid});
  REQUIRE(expected);
  CHECK(hashes[0] == expected->fit.proxy.hash());
}

TEST_CASE("capi: options of a fit that cannot be are refused, and a fit is canceled") {
  MeshArrays arrays(make_body().mesh);
  const Context context = make_context();
  const Skin skin = make_skin(context, arrays);
  bodice_fit_options options = bodice_default_fit_options();
  options.tier = 4;
  CHECK(skin.fit(context, options).status() == BODICE_INVALID_ARGUMENT);
  options = bodice_default_fit_options();
  options.target_error_m = std::nan("");
  CHECK(skin.fit(context, options).status() == BODICE_INVALID_ARGUMENT);
  options = bodice_default_fit_options();
  options.max_ellipsoids = -1;
  CHECK(skin.fit(context, options).status() == BODICE_INVALID_ARGUMENT);
  options = bodice_default_fit_options();
  int calls = 0;
  options.host = &calls;
  options.progress = [](void* host, const char*) -> std::int32_t { return ++*static_cast<int*>(host) > 3; };
  CHECK(skin.fit(context, options).status() == BODICE_CANCELED);  // relief takes longer than three pauses
  CHECK(calls >= 4);
}

TEST_CASE("capi: a ticket works beside the caller and gives the same proxy once") {
  MeshArrays arrays(make_body().mesh);
  const Context context = make_context();
  const bodice_mesh mesh = arrays.mesh();
  const bodice_fit_options options = solid();
  bodice_ticket* ticket = nullptr;
  must(bodice_fit_begin(context.get(), &mesh, nullptr, &options, &ticket));
  std::int32_t done = 0;
  while (!done) {
    must(bodice_ticket_poll(ticket, &done));
    std::this_thread::yield();
  }
  bodice_skin* skin = nullptr;
  bodice_proxy* proxy = nullptr;
  bodice_fit_report report = bodice_default_fit_report();
  must(bodice_ticket_take(ticket, &skin, &proxy, &report));
  const Skin owned_skin(skin);
  const Proxy owned_proxy(proxy);
  CHECK(hash_of(proxy) == hash_of(owned_skin.fit(context, options)->get()));
  CHECK(report.ellipsoids > 20);
  CHECK(bodice_ticket_take(ticket, nullptr, &proxy, nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(proxy == nullptr);
  bodice_ticket_destroy(ticket);

  must(bodice_fit_begin(context.get(), &mesh, nullptr, nullptr, &ticket));
  must(bodice_ticket_cancel(ticket));
  CHECK(bodice_ticket_take(ticket, nullptr, &proxy, nullptr) == BODICE_CANCELED);
  bodice_ticket_destroy(ticket);
  must(bodice_fit_begin(context.get(), &mesh, nullptr, nullptr, &ticket));
  bodice_ticket_destroy(ticket);  // while it works

  arrays.triangles[5] = 1000000;
  CHECK(bodice_fit_begin(context.get(), &mesh, nullptr, nullptr, &ticket) == BODICE_INVALID_ARGUMENT);
  CHECK(ticket == nullptr);
}

TEST_CASE("capi: a proxy is bound to the bones of the host, and stays where it is in their bind pose") {
  const synth::Body body = make_body();
  MeshArrays arrays(body.mesh);
  RigArrays bones(body);
  const Context context = make_context();
  const Skin skin = make_skin(context, arrays, with_rig(bones.rig));
  CHECK(skin.info()->joints == bones.parents.size());
  const auto proxy = skin.fit(context, solid());
  REQUIRE_MESSAGE(proxy, bodice_last_error());
  CHECK(proxy->info()->joints == bones.parents.size());
  CHECK(bodice_proxy_joint_name(proxy->get(), 1) == std::string(bones.names[1]));
  auto collider = Collider::create(context, *proxy);
  REQUIRE(collider);
  const double* point = &arrays.xyz[300];
  bodice_contact rest, posed;
  must(bodice_query_point(collider->get(), point, &rest));
  must(bodice_collider_pose(collider->get(), &bones.bind));
  must(bodice_query_point(collider->get(), point, &posed));
  CHECK(posed.distance == doctest::Approx(rest.distance).epsilon(0.001));
  // The body carried by 2 m: the point there has the same distance.
  for (std::size_t j = 0; j < bones.parents.size(); ++j) bones.matrices[12 * j + 3] += 2.0;
  must(bodice_collider_pose(collider->get(), &bones.bind));
  const double moved[3] = {point[0] + 2.0, point[1], point[2]};
  must(bodice_query_point(collider->get(), moved, &posed));
  CHECK(std::abs(posed.distance - rest.distance) < 1e-5f);

  bodice_fit_options unbound = solid();
  unbound.bind = 0;
  CHECK(skin.fit(context, unbound)->info()->joints == 0);
}

TEST_CASE("capi: a saved proxy is bound to the bones of the host without another fit") {
  const synth::Body body = make_body();
  MeshArrays arrays(body.mesh);
  RigArrays bones(body);
  const Context context = make_context();
  const Skin skin = make_skin(context, arrays, with_rig(bones.rig));
  const auto saved = make_skin(context, arrays).fit(context, solid());
  REQUIRE_MESSAGE(saved, bodice_last_error());
  REQUIRE(saved->info()->joints == 0);
  const auto bound = saved->bind(context, skin);
  REQUIRE_MESSAGE(bound, bodice_last_error());
  CHECK(bound->info()->joints == bones.parents.size());
  CHECK(bound->info()->ellipsoids == saved->info()->ellipsoids);
  // Each ellipsoid follows the joint of the largest weight, which the skin there has.
  std::size_t agree = 0;
  std::vector<bodice_ellipsoid> ellipsoids(bound->info()->ellipsoids);
  must(bodice_proxy_get_ellipsoids(bound->get(), ellipsoids.data(), ellipsoids.size()));
  for (std::uint32_t k = 0; k < ellipsoids.size(); ++k) {
    std::vector<std::uint16_t> joint(bones.parents.size());
    std::vector<float> weight(joint.size());
    std::size_t count = 0;
    must(bodice_proxy_get_joint_weights(bound->get(), k, joint.data(), weight.data(), joint.size(), &count));
    REQUIRE(count > 0);
    REQUIRE(count <= joint.size());
    const auto largest =
        std::max_element(weight.begin(), weight.begin() + static_cast<std::ptrdiff_t>(count));
    agree += joint[static_cast<std::size_t>(largest - weight.begin())] == ellipsoids[k].bone;
  }
  CHECK(10 * agree >= 9 * ellipsoids.size());

  // The forearms of the bound proxy bend as those of a proxy that was fitted to the skin with the rig.
  const auto fitted = skin.fit(context, solid());
  auto one = Collider::create(context, *bound), other = Collider::create(context, *fitted);
  REQUIRE(one);
  REQUIRE(other);
  for (std::size_t j = 0; j < bones.parents.size(); ++j)
    if (std::string(bones.names[j]).find("forearm") != std::string::npos) bones.matrices[12 * j + 7] += 0.05;
  must(bodice_collider_pose(one->get(), &bones.bind));
  must(bodice_collider_pose(other->get(), &bones.bind));
  double sum = 0.0;
  for (std::size_t v = 0; v < arrays.xyz.size(); v += 30) {
    bodice_contact a, b;
    must(bodice_query_point(one->get(), &arrays.xyz[v], &a));
    must(bodice_query_point(other->get(), &arrays.xyz[v], &b));
    sum += std::abs(double{a.distance} - double{b.distance});
  }
  CHECK(sum / static_cast<double>((arrays.xyz.size() + 29) / 30) < 0.004);

  bodice_proxy* none = nullptr;
  CHECK(bodice_proxy_bind(context.get(), saved->get(), make_skin(context, arrays).get(), &none) ==
        BODICE_INVALID_ARGUMENT);
  CHECK(std::string(bodice_last_error()).find("has no rig") != std::string::npos);
  MeshArrays elsewhere(body.mesh);
  for (std::size_t i = 0; i < elsewhere.xyz.size(); i += 3) elsewhere.xyz[i] += 1.0;
  RigArrays moved(body);
  for (std::size_t j = 0; j < moved.parents.size(); ++j) moved.matrices[12 * j + 3] += 1.0;
  CHECK(saved->bind(context, make_skin(context, elsewhere, with_rig(moved.rig))).status() ==
        BODICE_INVALID_ARGUMENT);
  CHECK(std::string(bodice_last_error()).find("not of this skin") != std::string::npos);
  CHECK(bodice_proxy_bind(nullptr, saved->get(), skin.get(), &none) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_proxy_bind(context.get(), nullptr, skin.get(), &none) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_proxy_bind(context.get(), saved->get(), nullptr, &none) == BODICE_INVALID_ARGUMENT);
  CHECK(bodice_proxy_bind(context.get(), saved->get(), skin.get(), nullptr) == BODICE_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}

TEST_CASE("capi: bones that cannot be are refused by name") {
  const synth::Body body = make_body();
  MeshArrays arrays(body.mesh);
  const Context context = make_context();
  const auto refused = [&](RigArrays& bones, const char* word) {
    CAPTURE(word);
    CHECK(Skin::from_mesh(context, arrays.mesh(), with_rig(bones.rig)).status() == BODICE_INVALID_ARGUMENT);
    CHECK(std::string(bodice_last_error()).find(word) != std::string::npos);
  };
  RigArrays bones(body);
  bones.parents[2] = 2;
  refused(bones, "Joint 2 has the parent 2");
  bones = RigArrays(body);
  bones.matrices[12 * 3] = std::nan("");
  bones.bind.matrices = bones.matrices.data();
  bones.rig.bind = &bones.bind;
  refused(bones, "joint 3");
  bones = RigArrays(body);
  bones.rig.bind = &bones.bind;
  bones.rig.vertices -= 1;
  refused(bones, "Pass the weights of this mesh");
  bones = RigArrays(body);
  bones.rig.bind = &bones.bind;
  bones.weight[8] = -1.0f;
  refused(bones, "Vertex 1 has the weight");
  bones = RigArrays(body);
  bones.rig.bind = nullptr;
  refused(bones, "bodice_pose is null");
}
