#include <cmath>
#include <memory>
#include <numbers>

#include <bodice/cloth/solver.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/frame_pipeline.hpp>
#include <bodice/engine/hash.hpp>
#include <bodice/engine/random.hpp>
#include "stage.hpp"

namespace bodice_bench {
namespace {

using namespace bodice;
using engine::Context;
using geometry::Vec3;

// 88 ellipsoids stacked like a trunk of .3 m radius and 1.6 m height.
std::shared_ptr<const collision::Collider> make_trunk() {
  proxy::BodyProxy::Data data;
  data.stature_m = 1.6;
  for (int i = 0; i < 88; ++i) {
    proxy::ProxyEllipsoid part;
    const double angle = 2.4 * i;
    part.shape.center = Vec3(0.15 * std::cos(angle), 0.1 + 1.4 * i / 88, 0.15 * std::sin(angle));
    part.shape.radii = Vec3(0.15, 0.1, 0.12);
    data.ellipsoids.push_back(part);
  }
  return std::make_shared<const collision::Collider>(proxy::BodyProxy::make(std::move(data)).value());
}

// A tube of cloth round the trunk, `particles` in all.
geometry::TriMesh make_tube(std::size_t particles) {
  const auto around = static_cast<std::uint32_t>(std::sqrt(2.0 * static_cast<double>(particles)));
  const auto rows = static_cast<std::uint32_t>(particles / around);
  geometry::TriMesh mesh;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around;
      mesh.positions.emplace_back(0.34 * std::cos(angle), 1.5 - 0.9 * row / rows, 0.34 * std::sin(angle));
      if (row == 0) continue;
      const std::uint32_t a = row * around + i, b = row * around + (i + 1) % around;
      mesh.triangles.push_back({a - around, b - around, a});
      mesh.triangles.push_back({b - around, b, a});
    }
  }
  return mesh;
}

struct ParticleSet {
  explicit ParticleSet(std::size_t count) {
    engine::Random random(5);
    for (auto* values : {&x, &y, &z}) values->resize(count);
    for (std::size_t i = 0; i < count; ++i) {  // along a helix, so that neighbors lie together
      const double t = static_cast<double>(i) / static_cast<double>(count), angle = 400.0 * t;
      const double radius = 0.25 + 0.06 * random.uniform();
      x[i] = static_cast<float>(radius * std::cos(angle));
      y[i] = static_cast<float>(1.5 * t - 0.7);
      z[i] = static_cast<float>(radius * std::sin(angle));
    }
  }
  std::vector<float> x, y, z;
};

struct Drape {
  Drape(std::size_t particles, int substeps)
      : solver(cloth::Solver::make(make_tube(particles), {}, cloth::find_fabric("cotton").value(),
                                   {.substeps = substeps, .self_collision = false})
                   .value()) {}
  cloth::Solver solver;
};

}  // namespace

Stage collision_stage() {
  return {"collision, 88 ellipsoids", "particles", 100'000, 1'000'000, [](std::size_t size) -> Work {
            const auto collider = make_trunk();
            const auto start = std::make_shared<const ParticleSet>(size);
            const auto now = std::make_shared<ParticleSet>(*start);
            return [=](const Context& context) {
              *now = *start;
              collision::Particles particles;
              particles.count = now->x.size();
              particles.x = now->x.data();
              particles.y = now->y.data();
              particles.z = now->z.data();
              const auto report = collider->resolve(context, particles, {});
              engine::Hasher hasher;
              hasher.add(report.contacts);
              hasher.add(now->x[particles.count / 2]);
              return hasher.value();
            };
          }};
}

// The cloth moves on from run to run; the worker counts take turns, so that all see the same stretch of it.
Stage cloth_stage() {
  return {"cloth, 8 substeps", "particles", 10'000, 100'000, [](std::size_t size) -> Work {
            const auto collider = make_trunk();
            return [=, drape = std::make_shared<Drape>(size, 8)](const Context& context) {
              const auto report = drape->solver.step(context, *collider, 1.0 / 60.0);
              return static_cast<std::uint64_t>(report.finite);
            };
          }};
}

Stage frame_stage() {
  return {"whole frame in a pipeline",
          "particles",
          10'000,
          100'000,
          [](std::size_t size) -> Work {
            const auto collider = make_trunk();
            return [=, drape = std::make_shared<Drape>(size, 8)](const Context& context) {
              engine::FramePipeline pipeline(context, {});
              bool finite = false;
              pipeline.frame([&](const Context& frame) {
                finite = drape->solver.step(frame, *collider, 1.0 / 60.0).finite;
              });
              return static_cast<std::uint64_t>(finite);
            };
          },
          true};
}

}  // namespace bodice_bench
