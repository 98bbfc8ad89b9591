#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <bodice/io/scene.hpp>
#include <bodice_test/shapes.hpp>

#include "figure.hpp"

namespace io_test {

/// The figure with parts, two ellipsoids and a skirt that swings sideways over three frames.
struct SceneFixture {
  explicit SceneFixture(const bodice::geometry::Frame& frame = {}) {
    using namespace bodice;
    for (const Vec3& p : body.positions)
      part.push_back(p.y() > 1.0 ? body::Part::kHead : body::Part::kThighL);
    proxy::BodyProxy::Data data;
    data.stature_m = 1.7;
    data.frame = frame;
    proxy::ProxyEllipsoid ellipsoid;
    ellipsoid.shape.center = Vec3(0.05, 1.3, 0.02);
    ellipsoid.shape.radii = Vec3(0.25, 0.35, 0.12);
    ellipsoid.shape.axes << std::cos(0.4), -std::sin(0.4), 0, std::sin(0.4), std::cos(0.4), 0, 0, 0, 1;
    data.ellipsoids.push_back(ellipsoid);
    ellipsoid.shape.center.y() = 0.5;
    ellipsoid.part = body::Part::kThighL;
    data.ellipsoids.push_back(ellipsoid);
    auto made = proxy::BodyProxy::make(data);
    if (made.ok()) proxies.push_back(*made);

    io::GarmentTrack track;
    track.name = "cloth";
    track.mesh = mapped(bodice_test::cylinder(0.35, 0.6, 24, 6, false),
                        [](const Vec3& p) { return Vec3(p + Vec3(0.0, 0.6, 0.0)); });
    for (int k = 0; k < 3; ++k) {
      track.frames.push_back(track.mesh.positions);
      for (Vec3& p : track.frames.back()) p.x() += 0.1 * k * (1.0 - p.y());
      track.time_s.push_back(0.5 * k);
    }
    scene.body = &body;
    scene.part = part;
    scene.proxy = proxies.empty() ? nullptr : &proxies.front();
    scene.garments.push_back(track);
    scene.frame = frame;
  }
  SceneFixture(const SceneFixture&) = delete;
  SceneFixture& operator=(const SceneFixture&) = delete;

  TriMesh body = figure();
  std::vector<bodice::body::Part> part;
  std::vector<bodice::proxy::BodyProxy> proxies;
  bodice::io::Scene scene;
};

}  // namespace io_test
