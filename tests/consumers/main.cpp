// A runtime with ready proxies: it links collision alone, and pushes one particle out of a sphere.
#include <cmath>
#include <cstdio>

#include <bodice/collision/collider.hpp>
#include <bodice/proxy/body_proxy.hpp>

int main() {
  int unused_on_purpose = 0;  // an error if the warning flags leaked to this project
  bodice::proxy::BodyProxy::Data data;
  data.stature_m = 1.7;
  data.ellipsoids.resize(1);
  auto proxy = bodice::proxy::BodyProxy::make(data);
  if (!proxy) return std::fprintf(stderr, "%s\n", proxy.error().sentence().c_str()), 1;

  const bodice::collision::Collider collider(*proxy);
  float x = 0.5f - static_cast<float>(collider.origin().x()), y = -static_cast<float>(collider.origin().y()),
        z = -static_cast<float>(collider.origin().z());
  bodice::collision::Particles particles;
  particles.count = 1;
  particles.x = &x, particles.y = &y, particles.z = &z;
  const auto report = collider.resolve({}, particles, {});
  const float moved_to = x + static_cast<float>(collider.origin().x());
  std::printf("%d contact, moved to x = %g m\n", static_cast<int>(report.contacts),
              static_cast<double>(moved_to));
  return report.contacts == 1 && std::abs(moved_to - 1.0f) < 1e-4f ? 0 : 1;
}
