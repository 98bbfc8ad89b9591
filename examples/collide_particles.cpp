// Your own solver, our collision: all it needs is a proxy and arrays of particles.
//
//     proxy file --load--> BodyProxy --bake--> Collider
//                                                 |  each substep
//     your particles x[] y[] z[] vx[] vy[] vz[] --+--> moved out of the body, velocities corrected, a report
//
// Links bodice::collision alone: no assimp, no anatomy, no cloth.

#include <cmath>
#include <cstdio>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/proxy/proxy_file.hpp>

using namespace bodice;

namespace {

/// A torso of two ellipsoids, saved and loaded as a runtime would find it on disk.
engine::Result<proxy::BodyProxy> load_torso() {
  proxy::BodyProxy::Data torso;
  torso.stature_m = 1.7;
  torso.ellipsoids = {
      {.shape = {.center = {0, 1.2, 0}, .radii = {0.18, 0.25, 0.12}}, .part = body::Part::kTorsoUL},
      {.shape = {.center = {0, 0.95, 0}, .radii = {0.17, 0.2, 0.13}}, .part = body::Part::kTorsoLL}};
  auto made = proxy::BodyProxy::make(torso);
  if (!made) return made;
  if (auto saved = proxy::save(*made, "torso.bodice"); !saved) return saved.error();
  return proxy::load("torso.bodice");
}

}  // namespace

int main() {
  const auto torso = load_torso();
  if (!torso) return std::printf("%s\n", torso.error().sentence().c_str()), 1;
  const collision::Collider collider(*torso);
  const auto workers = engine::make_tbb_executor();
  const engine::Context context{.executor = workers.get()};

  // A sheet that falls on the chest from in front: positions relative to the collider's origin.
  const int side = 40;
  const std::size_t count = side * side;
  std::vector<float> x(count), y(count), z(count), vx(count), vy(count), vz(count, -2.0f);
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = 0.4f * (static_cast<float>(i % side) / side - 0.5f) - static_cast<float>(collider.origin().x());
    y[i] = 1.1f + 0.4f * (static_cast<float>(i / side) / side - 0.5f) -
           static_cast<float>(collider.origin().y());
    z[i] = 0.3f - static_cast<float>(collider.origin().z());
  }
  const collision::Particles particles{.count = count,
                                       .x = x.data(),
                                       .y = y.data(),
                                       .z = z.data(),
                                       .vx = vx.data(),
                                       .vy = vy.data(),
                                       .vz = vz.data()};
  const float dt_s = 1.0f / 480.0f;
  collision::ContactReport report;
  for (int step = 0; step < 60; ++step) {
    for (std::size_t i = 0; i < count; ++i) z[i] += vz[i] * dt_s;
    report = collider.resolve(context, particles, {.thickness_m = 0.001f, .friction = 0.4f});
  }
  std::printf("%d of %zu particles rest on the torso, %d unresolved\n", static_cast<int>(report.contacts),
              count, static_cast<int>(report.unresolved));
  return report.contacts > 0 && report.unresolved == 0 ? 0 : 1;
}
