// The C interface reads and writes particles where the host has them; the engine's own call is the oracle.
#include <cstring>
#include <limits>

#include "capi/scene.hpp"

using namespace capi_test;

namespace {

struct Fat {
  float before;
  float position[3];
  char between[5];
  float velocity[3];
  float safe[3];
};

constexpr std::size_t kCount = 3000;

/// What the engine makes of the cloud.
bodice::collision::ContactReport resolved(const Scene& scene, Cloud& cloud) {
  bodice::collision::Workspace workspace;
  return scene.engine.resolve({}, cloud.particles(), {.thickness_m = 0.002f}, workspace);
}

bodice_resolve_options thick() {
  bodice_resolve_options options = bodice_default_resolve_options();
  options.thickness_m = 0.002f;
  return options;
}

bodice_particles soa(Cloud& cloud) {
  bodice_particles particles = bodice_default_particles();
  particles.count = cloud.size();
  particles.space = BODICE_LOCAL;
  particles.position = {cloud.x.data(), cloud.y.data(), cloud.z.data(), 0, BODICE_FLOAT, 0};
  particles.velocity = {cloud.vx.data(), cloud.vy.data(), cloud.vz.data(), 0, BODICE_FLOAT, 0};
  particles.safe = {cloud.sx.data(), cloud.sy.data(), cloud.sz.data(), 0, BODICE_FLOAT, 0};
  return particles;
}

std::vector<Fat> structures(const Cloud& cloud) {
  std::vector<Fat> all(cloud.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = {float(i),
              {cloud.x[i], cloud.y[i], cloud.z[i]},
              {1, 2, 3, 4, 5},
              {cloud.vx[i], cloud.vy[i], cloud.vz[i]},
              {cloud.sx[i], cloud.sy[i], cloud.sz[i]}};
  return all;
}

bodice_particles aos(std::vector<Fat>& all) {
  bodice_particles particles = bodice_default_particles();
  particles.count = all.size();
  particles.space = BODICE_LOCAL;
  particles.position = {all[0].position, nullptr, nullptr, sizeof(Fat), BODICE_FLOAT, 0};
  particles.velocity = {all[0].velocity, nullptr, nullptr, sizeof(Fat), BODICE_FLOAT, 0};
  particles.safe = {all[0].safe, nullptr, nullptr, sizeof(Fat), BODICE_FLOAT, 0};
  return particles;
}

bool same(const Cloud& a, const Cloud& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.vx == b.vx && a.vy == b.vy && a.vz == b.vz;
}

bool same(const std::vector<Fat>& all, const Cloud& b) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Fat& a = all[i];
    if (a.position[0] != b.x[i] || a.position[1] != b.y[i] || a.position[2] != b.z[i]) return false;
    if (a.velocity[0] != b.vx[i] || a.velocity[1] != b.vy[i] || a.velocity[2] != b.vz[i]) return false;
    if (a.before != float(i) || a.between[4] != 5) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("capi: packed arrays and arrays of structures are resolved to the bits of the engine") {
  for (const bool relief : {false, true}) {
    CAPTURE(relief);
    Scene scene(limb_proxy(relief));
    Cloud truth = cloud_around_limb(kCount, 1), cloud = truth;
    std::vector<Fat> fat = structures(cloud);
    const auto expected = resolved(scene, truth);
    REQUIRE(expected.contacts > kCount / 10);

    const auto packed = scene.collider.resolve(soa(cloud), scene.workspace, thick());
    REQUIRE_MESSAGE(packed, bodice_last_error());
    CHECK(packed->contacts == expected.contacts);
    CHECK(packed->deepest_m == expected.deepest_m);
    CHECK(same(cloud, truth));

    const auto strided = scene.collider.resolve(aos(fat), scene.workspace, thick());
    REQUIRE_MESSAGE(strided, bodice_last_error());
    CHECK(strided->contacts == expected.contacts);
    CHECK(same(fat, truth));
  }
}

TEST_CASE(
    "capi: structures of three and of four numbers, floats and doubles, are resolved to the same bits") {
  Scene scene(limb_proxy(true));
  const Cloud start = cloud_around_limb(kCount, 9);
  Cloud truth = start;
  scene.engine.resolve({}, {.count = kCount, .x = truth.x.data(), .y = truth.y.data(), .z = truth.z.data()},
                       {.thickness_m = 0.002f});
  const auto wrong_as = [&](auto scalar, std::size_t numbers) {
    using Scalar = decltype(scalar);
    std::vector<Scalar> all(numbers * kCount, Scalar{7});
    const auto at = [&](std::size_t i) { return &all[numbers * i]; };
    for (std::size_t i = 0; i < kCount; ++i)
      at(i)[0] = Scalar{start.x[i]}, at(i)[1] = Scalar{start.y[i]}, at(i)[2] = Scalar{start.z[i]};
    bodice_particles particles = bodice_default_particles();
    particles.count = kCount;
    particles.space = BODICE_LOCAL;
    particles.position = {all.data(),
                          nullptr,
                          nullptr,
                          static_cast<std::ptrdiff_t>(numbers * sizeof(Scalar)),
                          sizeof(Scalar) == 8 ? BODICE_DOUBLE : BODICE_FLOAT,
                          0};
    REQUIRE(scene.collider.resolve(particles, scene.workspace, thick()));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      wrong += at(i)[0] != Scalar{truth.x[i]} || at(i)[1] != Scalar{truth.y[i]};
      wrong += at(i)[2] != Scalar{truth.z[i]} || (numbers == 4 && at(i)[3] != Scalar{7});
    }
    return wrong;
  };
  CHECK(wrong_as(float{}, 3) + wrong_as(float{}, 4) == 0);
  CHECK(wrong_as(double{}, 3) + wrong_as(double{}, 4) == 0);
}

TEST_CASE("capi: an element that an index lists twice ends alike for any number of threads") {
  const std::size_t count = 3 * kCount;
  const std::vector<Fat> before = structures(cloud_around_limb(count, 10));
  std::vector<std::uint32_t> index;
  for (std::uint32_t i = 0; i < count; ++i) index.push_back(i % 2 == 0 ? i : std::uint32_t(count) - 1 - i);
  std::vector<Fat> ends[2];
  for (const int workers : {1, 4}) {
    Scene scene(limb_proxy(false), workers);
    std::vector<Fat>& all = ends[workers == 4] = before;
    bodice_particles particles = aos(all);
    particles.index = index.data();
    particles.elements = count;
    REQUIRE(scene.collider.resolve(particles, scene.workspace, thick()));
  }
  std::size_t wrong = 0, moved = 0;
  for (std::size_t i = 0; i < count; ++i) {
    wrong += std::memcmp(ends[0][i].position, ends[1][i].position, sizeof ends[0][i].position) != 0;
    moved += std::memcmp(ends[0][i].position, before[i].position, sizeof before[i].position) != 0;
  }
  CHECK(wrong == 0);
  CHECK(moved > count / 20);
}

TEST_CASE("capi: an index and a negative stride visit the same particles in another order") {
  Scene scene(limb_proxy(true));
  Cloud truth = cloud_around_limb(kCount, 2);
  std::vector<Fat> fat = structures(truth);
  resolved(scene, truth);

  std::vector<Fat> reversed(fat.rbegin(), fat.rend());
  bodice_particles backward = aos(reversed);
  for (bodice_vectors* vectors : {&backward.position, &backward.velocity, &backward.safe}) {
    vectors->x = static_cast<char*>(vectors->x) + (kCount - 1) * sizeof(Fat);
    vectors->stride = -static_cast<std::ptrdiff_t>(sizeof(Fat));
  }
  REQUIRE(scene.collider.resolve(backward, scene.workspace, thick()));
  CHECK(same(std::vector<Fat>(reversed.rbegin(), reversed.rend()), truth));

  // Every third element only; all others keep their bits.
  std::vector<std::uint32_t> index;
  for (std::uint32_t i = 0; i < kCount; i += 3) index.push_back(kCount - 1 - i);
  std::vector<Fat> some = fat;
  bodice_particles indexed = aos(some);
  indexed.index = index.data();
  indexed.count = index.size();
  indexed.elements = kCount;
  REQUIRE(scene.collider.resolve(indexed, scene.workspace, thick()));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const bool listed = (kCount - 1 - i) % 3 == 0;
    const float x = listed ? truth.x[i] : fat[i].position[0], v = listed ? truth.vx[i] : fat[i].velocity[0];
    wrong += some[i].position[0] != x || some[i].velocity[0] != v;
  }
  CHECK(wrong == 0);
}

TEST_CASE("capi: particles without mass or outside the mask keep their bits") {
  Scene scene(limb_proxy(false));
  Cloud truth = cloud_around_limb(kCount, 3);
  const std::vector<Fat> before = structures(truth);
  resolved(scene, truth);
  std::vector<Fat> fat = before;
  std::vector<double> inverse_mass(kCount);
  std::vector<std::uint8_t> mask(2 * kCount, 0);
  for (std::size_t i = 0; i < kCount; ++i) {
    inverse_mass[i] = i % 2 ? 0.5 : 0.0;
    mask[2 * i] = i % 5 != 0;
  }
  bodice_particles particles = aos(fat);
  particles.inverse_mass = {inverse_mass.data(), 0, BODICE_DOUBLE, 0};
  particles.mask = mask.data();
  particles.mask_stride = 2;
  const auto report = scene.collider.resolve(particles, scene.workspace, thick());
  REQUIRE_MESSAGE(report, bodice_last_error());
  std::size_t wrong = 0, pinned = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const bool free = i % 2 && i % 5 != 0;
    pinned += !free;
    wrong += fat[i].position[1] != (free ? truth.y[i] : before[i].position[1]);
    wrong += fat[i].velocity[1] != (free ? truth.vy[i] : before[i].velocity[1]);
  }
  CHECK(wrong == 0);
  CHECK(report->pinned == pinned);
}

TEST_CASE("capi: in world coordinates of doubles only particles with a contact change") {
  auto data = bodice_test::data_of(bodice_test::limb());
  for (auto& ellipsoid : data.ellipsoids) ellipsoid.shape.center += bodice_test::Vec3(3.0, 1.5, -2.0);
  Scene scene(bodice_test::proxy_of(data));
  Cloud truth = cloud_around_limb(kCount, 4);
  truth.sx.clear(), truth.vx.clear(), truth.sy.clear(), truth.sz.clear();
  const bodice_test::Vec3 origin = scene.engine.origin();
  std::vector<double> world;
  for (std::size_t i = 0; i < kCount; ++i)
    for (int axis = 0; axis < 3; ++axis) world.push_back(truth.position(i)[axis] + origin[axis] + 1e-12);
  const std::vector<double> before = world;
  const Cloud start = truth;
  const auto expected = scene.engine.resolve(
      {}, {.count = kCount, .x = truth.x.data(), .y = truth.y.data(), .z = truth.z.data()},
      {.thickness_m = 0.002f});
  bodice::Particles particles(kCount);
  particles.position(world.data());
  const auto report = scene.collider.resolve(particles, scene.workspace, thick());
  REQUIRE_MESSAGE(report, bodice_last_error());
  CHECK(report->contacts == expected.contacts);
  double worst = 0.0;
  std::size_t touched = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const bool moved = truth.position(i) != start.position(i);
    for (int axis = 0; axis < 3; ++axis) {
      worst = std::max(worst, std::abs(world[3 * i + axis] - origin[axis] - truth.position(i)[axis]));
      touched += !moved && world[3 * i + axis] != before[3 * i + axis];
    }
  }
  CHECK(worst < 1e-6);
  CHECK(touched == 0);
}

TEST_CASE("capi: a query fills every array that the host wants, as the engine does") {
  for (const bool relief : {false, true}) {
    Scene scene(limb_proxy(relief));
    Cloud cloud = cloud_around_limb(kCount, 5);
    cloud.x[7] = std::numeric_limits<float>::quiet_NaN();
    std::vector<bodice::collision::Contact> truth(kCount);
    scene.engine.query({}, cloud.particles(), truth);
    std::vector<double> distance(kCount), normal(3 * kCount);
    std::vector<float> point(3 * kCount);
    std::vector<std::uint32_t> ellipsoid(kCount);
    std::vector<std::uint8_t> part(kCount);
    struct Wide {
      int other;
      bodice_contact contact;
    };
    std::vector<Wide> wide(kCount);
    bodice_contacts contacts = bodice_default_contacts();
    contacts.contact = &wide[0].contact;
    contacts.contact_stride = sizeof(Wide);
    contacts.distance = {distance.data(), 0, BODICE_DOUBLE, 0};
    contacts.normal = {normal.data(), nullptr, nullptr, 0, BODICE_DOUBLE, 0};
    contacts.point = {point.data(), nullptr, nullptr, 0, BODICE_FLOAT, 0};
    contacts.ellipsoid = ellipsoid.data();
    contacts.part = part.data();
    const bodice_particles particles = soa(cloud);
    REQUIRE(scene.collider.query(particles, scene.workspace, contacts) == BODICE_OK);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto& c = truth[i];
      wrong += distance[i] != double{c.signed_distance} || wide[i].contact.distance != c.signed_distance;
      wrong += ellipsoid[i] != c.ellipsoid || normal[3 * i + 1] != double{c.normal[1]};
      wrong += point[3 * i + 2] != c.point[2];
      const bool none = c.ellipsoid == BODICE_NO_ELLIPSOID;
      wrong += part[i] != (none ? 255 : c.ellipsoid % bodice::body::kPartCount);
    }
    CHECK(wrong == 0);
    CHECK(ellipsoid[7] == BODICE_NO_ELLIPSOID);

    // The same straight into aligned memory.
    std::vector<bodice::collision::Contact> direct(kCount);
    bodice_contacts packed = bodice_default_contacts();
    packed.contact = reinterpret_cast<bodice_contact*>(direct.data());
    REQUIRE(scene.collider.query(particles, scene.workspace, packed) == BODICE_OK);
    CHECK(std::memcmp(direct.data(), truth.data(), kCount * sizeof(bodice_contact)) == 0);
  }
}
