// A frame as a host has it: the matrices of its bones, then its particles as structures in the world.
#include "frame.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <Eigen/Geometry>

#include <bodice.hpp>
#include <bodice/binding/bind.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/proxy/proxy_file.hpp>
#include <bodice/rig/rig.hpp>
#include <bodice_test/allocations.hpp>

namespace embedding {
namespace {

using namespace bodice;

constexpr std::size_t kParticles = 5000;
constexpr int kWarm = 30, kFrames = 300;
constexpr double kDt_s = 1.0 / 60.0;

struct Vertex {
  float position[3], velocity[3], uv[2];
};

/// Particles near the skin, repeatable.
std::vector<Vertex> cloth_around(const synth::Body& body) {
  engine::Random random(2);
  std::vector<Vertex> cloth(kParticles);
  for (std::size_t i = 0; i < kParticles; ++i)
    for (int axis = 0; axis < 3; ++axis)
      cloth[i].position[axis] =
          static_cast<float>(body.mesh.positions[i * body.mesh.positions.size() / kParticles][axis] +
                             random.uniform(-0.017, 0.017));
  return cloth;
}

/// The matrices of a frame, rows of 3 x 4 floats: the body sways by some degrees about its own axis.
void sway(const synth::Body& body, int frame, std::vector<float>& rows) {
  const geometry::Mat3 turn =
      Eigen::AngleAxisd(0.05 * std::sin(0.1 * frame), geometry::Vec3::UnitY()).toRotationMatrix();
  for (std::size_t joint = 0; joint < body.skeleton.joints.size(); ++joint) {
    const rig::Affine world = turn * body.skeleton.joints[joint].bind;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c)
        rows[12 * joint + static_cast<std::size_t>(4 * r + c)] = static_cast<float>(world(r, c));
  }
}

[[noreturn]] void fail(const char* sentence) {
  std::puts(sentence);
  std::exit(1);
}

struct Frame {
  double pose_us, resolve_us;
};

void print(const char* name, std::vector<Frame>& frames, std::size_t calls) {
  const auto by = [&](double Frame::*time) {
    std::ranges::sort(frames, {}, time);
    return std::pair{frames[frames.size() / 2].*time, frames.front().*time};
  };
  const auto [pose, least_pose] = by(&Frame::pose_us);
  const auto [resolve, least_resolve] = by(&Frame::resolve_us);
  std::printf("| %s | %.0f (%.0f) | %.0f (%.0f) | ", name, pose, least_pose, resolve, least_resolve);
  bodice_test::counts_allocations() ? std::printf("%zu |\n", calls) : std::printf("not counted here |\n");
}

}  // namespace

std::size_t print_frames(const synth::Body& body, const proxy::BodyProxy& proxy, const char* name) {
  const auto bound = binding::bind({}, proxy, {body.mesh, body.skeleton, body.weights, body.part});
  if (!bound) fail(bound.error().sentence().c_str());
  const std::vector<std::byte> bytes = proxy::to_binary(*bound);
  auto context = Context::create();
  auto handle = Proxy::from_bytes(*context, bytes.data(), bytes.size());
  auto collider = ::bodice::Collider::create(*context, *handle);
  auto workspace = ::bodice::Workspace::create(*context);
  const std::vector<Vertex> start = cloth_around(body);
  std::vector<Vertex> cloth = start;
  ::bodice::Particles particles(kParticles);
  particles.position(cloth[0].position, sizeof(Vertex)).velocity(cloth[0].velocity, sizeof(Vertex));
  std::vector<float> rows(12 * body.skeleton.joints.size());
  std::vector<Frame> frames;
  frames.reserve(kFrames);
  std::size_t calls = 0;
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto us = [](auto time) { return std::chrono::duration<double, std::micro>(time).count(); };
  for (int frame = 0; frame < kWarm + kFrames; ++frame) {
    std::ranges::copy(start, cloth.begin());
    sway(body, frame, rows);
    const std::size_t before = bodice_test::allocations();
    const auto begin = now();
    if (collider->pose(rows.data(), body.skeleton.joints.size(), BODICE_ROWS_3X4, kDt_s) != BODICE_OK)
      fail(bodice_last_error());
    const auto posed = now();
    if (!collider->resolve(particles, *workspace)) fail(bodice_last_error());
    const auto end = now();
    if (frame < kWarm) continue;
    calls += bodice_test::allocations() - before;
    frames.push_back({us(posed - begin), us(end - posed)});
  }
  print(name, frames, calls);
  return bodice_test::counts_allocations() ? calls : 0;
}

}  // namespace embedding
