// Contacts of particles in the world; the engine's own call, in its local frame, is the oracle.
#include <cstring>

#include "capi/scene.hpp"

using namespace capi_test;

TEST_CASE("capi: contacts in the world differ from those of the engine by their points alone") {
  constexpr std::size_t kCount = 3000;
  auto data = bodice_test::data_of(bodice_test::limb());
  for (auto& ellipsoid : data.ellipsoids) ellipsoid.shape.center += bodice_test::Vec3(0.3, -0.7, 1.9);
  Scene scene(bodice_test::proxy_of(data));
  const auto origin = scene.engine.origin();
  REQUIRE(origin.cwiseAbs().minCoeff() > 0.1);
  Cloud cloud = cloud_around_limb(kCount, 6);
  std::vector<bodice::collision::Contact> truth(kCount), found(kCount);
  scene.engine.query({}, cloud.particles(), truth);
  std::vector<double> world;
  for (std::size_t i = 0; i < kCount; ++i)
    for (int axis = 0; axis < 3; ++axis)
      world.push_back(double{(axis == 0 ? cloud.x : axis == 1 ? cloud.y : cloud.z)[i]} + origin[axis]);
  bodice_particles particles = bodice_default_particles();
  particles.count = kCount;
  particles.position = {world.data(), nullptr, nullptr, 0, BODICE_DOUBLE, 0};
  bodice_contacts contacts = bodice_default_contacts();
  contacts.contact = reinterpret_cast<bodice_contact*>(found.data());
  REQUIRE(scene.collider.query(particles, scene.workspace, contacts) == BODICE_OK);
  for (auto& contact : truth)
    for (int axis = 0; axis < 3; ++axis)
      contact.point[axis] = static_cast<float>(double{contact.point[axis]} + origin[axis]);
  CHECK(std::memcmp(found.data(), truth.data(), kCount * sizeof(bodice_contact)) == 0);
}
