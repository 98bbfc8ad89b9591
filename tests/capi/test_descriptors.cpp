// Structures and parameters with every kind of garbage: a status and a sentence, and nothing has happened.
#include <cstring>
#include <limits>
#include <utility>

#include "capi/scene.hpp"

using namespace capi_test;

namespace {

/// The statuses that garbage may have; a crash ends the suite.
bool is_refusal(bodice_status status) {
  return status == BODICE_INVALID_ARGUMENT || status == BODICE_NOT_INITIALIZED ||
         status == BODICE_VERSION_MISMATCH || status == BODICE_UNREADABLE;
}

struct Fixture : Scene {
  std::vector<float> xyz = std::vector<float>(300, 0.01f);
  Fixture() : Scene(limb_proxy(true)) {}
  bodice_particles particles() {
    bodice_particles some = bodice_default_particles();
    some.count = 100;
    some.position = {xyz.data(), nullptr, nullptr, 0, BODICE_FLOAT, 0};
    return some;
  }
  bodice_status resolve(const bodice_particles& some) {
    return bodice_resolve(collider.get(), &some, nullptr, workspace.get(), nullptr);
  }
};

}  // namespace

TEST_CASE("capi: a structure without its defaults is refused, with the name of what makes them") {
  Fixture f;
  bodice_particles zero;
  std::memset(&zero, 0, sizeof zero);
  CHECK(f.resolve(zero) == BODICE_NOT_INITIALIZED);
  CHECK(std::string(bodice_last_error()).find("bodice_default_particles()") != std::string::npos);
  // The defaults of another structure are refused as well.
  bodice_pose pose = bodice_default_pose();
  std::memcpy(&zero.head, &pose.head, sizeof zero.head);
  CHECK(f.resolve(zero) == BODICE_NOT_INITIALIZED);
  bodice::engine::Random random(5);
  for (int round = 0; round < 2000; ++round) {
    for (std::size_t i = 0; i < sizeof zero; ++i)
      reinterpret_cast<unsigned char*>(&zero)[i] = static_cast<unsigned char>(random.below(256));
    CHECK(is_refusal(f.resolve(zero)));
  }
}

TEST_CASE("capi: older and newer programs are taken as long as they use what both sides have") {
  Fixture f;
  struct Newer {
    bodice_query_options known;
    int added[4];
  } newer;
  REQUIRE(bodice_fill_defaults(BODICE_QUERY_OPTIONS, &newer, sizeof newer) == BODICE_OK);
  CHECK(newer.known.head.struct_size == sizeof newer);
  CHECK(newer.known.within_m == std::numeric_limits<float>::infinity());
  CHECK(newer.added[3] == 0);
  const bodice_particles particles = f.particles();
  const bodice_contacts contacts = bodice_default_contacts();
  const auto query = [&] {
    return bodice_query(f.collider.get(), &particles, &newer.known, f.workspace.get(), &contacts);
  };
  CHECK(query() == BODICE_OK);
  newer.added[2] = 1;
  CHECK(query() == BODICE_VERSION_MISMATCH);
  CHECK(std::string(bodice_last_error()).find("bodice_query_options") == 0);
  newer.known.head.struct_size = 12;
  CHECK(query() == BODICE_VERSION_MISMATCH);
  newer.known.head.struct_size = 0xffffffffu;
  CHECK(query() == BODICE_VERSION_MISMATCH);
  CHECK(bodice_fill_defaults(BODICE_QUERY_OPTIONS, &newer, 4) == BODICE_VERSION_MISMATCH);
  CHECK(bodice_fill_defaults(77, &newer, sizeof newer) == BODICE_VERSION_MISMATCH);
  CHECK(bodice_fill_defaults(BODICE_QUERY_OPTIONS, nullptr, 16) == BODICE_INVALID_ARGUMENT);

  bodice_context_options options = bodice_default_context_options();
  options.abi = BODICE_ABI + 1;
  bodice_context* context = nullptr;
  CHECK(bodice_context_create(&options, &context) == BODICE_VERSION_MISMATCH);
  CHECK(context == nullptr);
  CHECK(std::string(bodice_last_error()).find("ABI 2") != std::string::npos);
}

TEST_CASE("capi: arrays that cannot be are refused before anything is read") {
  Fixture f;
  const std::vector<float> before = f.xyz;
  const auto refused = [&](const bodice_particles& some, const char* word) {
    CAPTURE(word);
    CHECK(f.resolve(some) == BODICE_INVALID_ARGUMENT);
    CHECK(std::string(bodice_last_error()).find(word) != std::string::npos);
  };
  bodice_particles some = f.particles();
  some.position.x = nullptr;
  refused(some, "position has no arrays");
  some = f.particles();
  some.position.y = f.xyz.data();
  refused(some, "lacks one of x, y and z");
  for (const std::ptrdiff_t stride : {1, 11, -1, -11}) {
    some = f.particles();
    some.position.stride = stride;
    refused(some, "stride");
  }
  some = f.particles();
  some.position.scalar = 2;
  refused(some, "BODICE_DOUBLE");
  some = f.particles();
  some.count = std::size_t{1} << 31;
  refused(some, "BODICE_MAX_PARTICLES");
  some.count = std::numeric_limits<std::size_t>::max();
  refused(some, "BODICE_MAX_PARTICLES");
  for (const std::ptrdiff_t stride :
       {std::numeric_limits<std::ptrdiff_t>::max(), std::numeric_limits<std::ptrdiff_t>::min()}) {
    some = f.particles();
    some.position.stride = stride;
    refused(some, "address space");
  }
  const std::uint32_t index[] = {0, 99, 100};
  some = f.particles();
  some.index = index;
  some.count = 3;
  some.elements = 100;
  refused(some, "index[2] is 100");
  some = f.particles();
  some.space = 7;
  refused(some, "BODICE_LOCAL");
  CHECK(f.xyz == before);
  some = f.particles();
  some.count = 0;
  some.position.x = nullptr;
  CHECK(f.resolve(some) == BODICE_OK);
}

TEST_CASE("capi: null in place of any handle or result is refused") {
  Fixture f;
  const bodice_particles some = f.particles();
  const bodice_contacts contacts = bodice_default_contacts();
  bodice_context* context = nullptr;
  bodice_proxy* proxy = nullptr;
  bodice_collider* collider = nullptr;
  bodice_workspace* workspace = nullptr;
  double point[3] = {0, 0, 0};
  bodice_contact contact;
  std::size_t count = 0;
  bodice_pose pose = bodice_default_pose();
  float fraction[100];
  const bodice_status all[] = {
      bodice_context_create(nullptr, nullptr),
      bodice_proxy_from_bytes(nullptr, "{", 1, &proxy),
      bodice_proxy_from_bytes(f.context.get(), nullptr, 5, &proxy),
      bodice_proxy_from_bytes(f.context.get(), "{", 0, &proxy),
      bodice_proxy_from_bytes(f.context.get(), "{", 1, nullptr),
      bodice_proxy_to_bytes(nullptr, BODICE_JSON, nullptr, 0, &count),
      bodice_proxy_to_bytes(f.proxy.get(), BODICE_JSON, nullptr, 0, nullptr),
      bodice_proxy_to_bytes(f.proxy.get(), 5, nullptr, 0, &count),
      bodice_proxy_get_info(nullptr, nullptr),
      bodice_proxy_get_info(f.proxy.get(), nullptr),
      bodice_proxy_get_ellipsoids(nullptr, nullptr, 0),
      bodice_proxy_get_ellipsoids(f.proxy.get(), nullptr, 1),
      bodice_proxy_get_bind(f.proxy.get(), 0, point),
      bodice_proxy_get_joint_weights(nullptr, 0, nullptr, nullptr, 0, &count),
      bodice_proxy_get_joint_weights(f.proxy.get(), 0, nullptr, nullptr, 0, nullptr),
      bodice_proxy_get_joint_weights(f.proxy.get(), 0, nullptr, fraction, 1, &count),
      bodice_proxy_get_joint_weights(f.proxy.get(), 1u << 31, nullptr, nullptr, 0, &count),
      bodice_collider_create(f.context.get(), nullptr, &collider),
      bodice_collider_create(nullptr, f.proxy.get(), &collider),
      bodice_collider_get_origin(nullptr, point),
      bodice_collider_get_origin(f.collider.get(), nullptr),
      bodice_collider_pose(nullptr, &pose),
      bodice_collider_pose(f.collider.get(), nullptr),
      bodice_collider_pose(f.collider.get(), &pose),
      bodice_collider_move(f.collider.get(), &pose),
      bodice_collider_cover(nullptr, &some, 0.001f, nullptr),
      bodice_collider_cover(f.collider.get(), nullptr, 0.001f, nullptr),
      bodice_collider_cover(f.collider.get(), &some, -0.001f, nullptr),
      bodice_collider_cover(f.collider.get(), &some, std::nanf(""), nullptr),
      bodice_workspace_create(nullptr, &workspace),
      bodice_query(nullptr, &some, nullptr, nullptr, &contacts),
      bodice_query(f.collider.get(), nullptr, nullptr, nullptr, &contacts),
      bodice_query(f.collider.get(), &some, nullptr, nullptr, nullptr),
      bodice_query_point(f.collider.get(), nullptr, &contact),
      bodice_query_point(f.collider.get(), point, nullptr),
      bodice_query_all(f.collider.get(), point, 1.0f, nullptr, 1, &count),
      bodice_query_all(f.collider.get(), point, 1.0f, &contact, 1, nullptr),
      bodice_resolve(nullptr, &some, nullptr, nullptr, nullptr),
      bodice_sweep(f.collider.get(), &some, 0.0f, nullptr, fraction, nullptr),
  };
  for (const bodice_status status : all) CHECK(is_refusal(status));
  CHECK(context == nullptr);
  CHECK(proxy == nullptr);
  bodice_context_destroy(nullptr);
  bodice_proxy_destroy(nullptr);
  bodice_collider_destroy(nullptr);
  bodice_workspace_destroy(nullptr);
  CHECK(bodice_part_name(-1) == nullptr);
  CHECK(std::string(bodice_part_name(BODICE_PARTS)) == "part_1");
  CHECK(std::string(bodice_part_name(BODICE_ALL_PARTS - 1)) == "part_16");
  CHECK(bodice_part_name(BODICE_ALL_PARTS) == nullptr);
  CHECK(std::string(bodice_part_name(0)) == "head");
  CHECK(bodice_proxy_joint_name(f.proxy.get(), 0) == nullptr);
  CHECK(std::string(bodice_status_name(99)) == "not a status of bodice");
}

TEST_CASE("capi: numbers that are no numbers stay where they are and are counted") {
  Fixture f;
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                       -1e38f};
  for (int i = 0; i < 3; ++i) f.xyz[static_cast<std::size_t>(30 * i)] = bad[i];
  const std::vector<float> before = f.xyz;
  bodice_contact_report report = bodice_default_contact_report();
  bodice_resolve_options options = bodice_default_resolve_options();
  options.friction = -bad[1];
  const bodice_particles some = f.particles();
  for (float* setting : {&options.thickness_m, &options.friction, &options.max_push_m, &options.blend_m}) {
    const float good = std::exchange(*setting, bad[0]);
    CHECK(bodice_resolve(f.collider.get(), &some, &options, f.workspace.get(), &report) ==
          BODICE_INVALID_ARGUMENT);
    CHECK(std::string(bodice_last_error()).find("is not a number") != std::string::npos);
    *setting = good;
  }
  CHECK(std::memcmp(f.xyz.data(), before.data(), before.size() * sizeof(float)) == 0);
  REQUIRE(bodice_resolve(f.collider.get(), &some, &options, f.workspace.get(), &report) == BODICE_OK);
  CHECK(report.not_finite == 2);
  CHECK(std::memcmp(&f.xyz[0], &before[0], 3 * sizeof(float)) == 0);
  CHECK(std::memcmp(&f.xyz[30], &before[30], 3 * sizeof(float)) == 0);
  const double nowhere[3] = {double{bad[0]}, 1e300, 0.0};
  bodice_contact contact;
  REQUIRE(bodice_query_point(f.collider.get(), nowhere, &contact) == BODICE_OK);
  CHECK(contact.ellipsoid == BODICE_NO_ELLIPSOID);
}

TEST_CASE("capi: damaged bytes of a proxy are refused, and both forms come back with the same hash") {
  Fixture f;
  bodice_proxy_info info = bodice_default_proxy_info();
  REQUIRE(bodice_proxy_get_info(f.proxy.get(), &info) == BODICE_OK);
  CHECK(info.hash == f.engine_proxy.hash());
  CHECK(info.ellipsoids == 9);
  for (const std::int32_t form : {BODICE_BINARY, BODICE_JSON}) {
    std::size_t size = 0;
    REQUIRE(bodice_proxy_to_bytes(f.proxy.get(), form, nullptr, 0, &size) == BODICE_OK);
    std::vector<char> bytes(size);
    CHECK(bodice_proxy_to_bytes(f.proxy.get(), form, bytes.data(), size - 1, &size) ==
          BODICE_INVALID_ARGUMENT);
    REQUIRE(bodice_proxy_to_bytes(f.proxy.get(), form, bytes.data(), size, &size) == BODICE_OK);
    auto again = bodice::Proxy::from_bytes(f.context, bytes.data(), bytes.size());
    REQUIRE_MESSAGE(again, bodice_last_error());
    CHECK(again->info()->hash == info.hash);
    bodice::engine::Random random(17);
    for (int round = 0; round < 300; ++round) {
      std::vector<char> hostile = bytes;
      hostile.resize(1 + random.below(static_cast<std::uint32_t>(size)));
      for (std::uint32_t i = 0; i < 1 + random.below(4); ++i)
        hostile[random.below(static_cast<std::uint32_t>(hostile.size()))] ^=
            static_cast<char>(1 << random.below(8));
      const auto broken = bodice::Proxy::from_bytes(f.context, hostile.data(), hostile.size());
      if (!broken) CHECK(is_refusal(broken.status()));
    }
  }
  std::vector<bodice_ellipsoid> ellipsoids(9);
  REQUIRE(bodice_proxy_get_ellipsoids(f.proxy.get(), ellipsoids.data(), 9) == BODICE_OK);
  CHECK(ellipsoids[3].center[0] == doctest::Approx(-0.08));
  CHECK(ellipsoids[3].radii[1] == doctest::Approx(0.05));
  CHECK(ellipsoids[3].part == 3);
  CHECK(ellipsoids[3].bone == -1);
}
