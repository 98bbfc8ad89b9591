// The C interface from C++17, without exceptions: a proxy from memory, and particles of which one is pinned.
//
//      .---.
//     / o-->x       free: comes out
//    |  O    |      pinned (inverse mass 0): stays
//     '-----'
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <bodice.hpp>

static_assert(__cplusplus < 202002L, "this file shows that C++17 serves");

namespace {

const std::string kBall = R"({"format": "bodice-proxy", "version": 2, "tier": "solid", "metres_per_unit": 1.0,
  "up": "y", "stature": 1.7, "margin": 0.0, "source_hash": "0000000000000000", "ellipsoids": [{"part": "head",
  "center": [0, 1.6, 0], "radii": [0.1, 0.1, 0.1], "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}],
  "relief": [], "texels": ""})";

struct Vertex {
  double position[3];
  float inverse_mass;
};

}  // namespace

int main() {
  auto context = bodice::Context::create();
  if (!context) return std::puts(context.error()), 1;
  auto broken = bodice::Proxy::from_bytes(*context, kBall.data(), kBall.size() / 2);
  if (broken || broken.status() != BODICE_UNREADABLE) return std::puts("half a file was read"), 1;
  std::puts(broken.error());
  auto proxy = bodice::Proxy::from_bytes(*context, kBall.data(), kBall.size());
  if (!proxy) return std::puts(proxy.error()), 1;
  auto collider = bodice::Collider::create(*context, *proxy);
  auto workspace = bodice::Workspace::create(*context);
  if (!collider || !workspace) return std::puts(bodice_last_error()), 1;

  std::vector<Vertex> vertices = {{{0.05, 1.6, 0.0}, 1.0f}, {{0.05, 1.6, 0.0}, 0.0f}};
  bodice::Particles particles(vertices.size());
  particles.position(&vertices[0].position[0], sizeof(Vertex));
  particles.inverse_mass(&vertices[0].inverse_mass, sizeof(Vertex));
  const auto report = collider->resolve(particles, *workspace);
  if (!report) return std::puts(report.error()), 1;
  const bool right = report->contacts == 1 && report->pinned == 1 &&
                     std::abs(vertices[0].position[0] - 0.1) < 1e-6 && vertices[1].position[0] == 0.05;
  return right ? 0 : (std::puts("the particles are not where they should be"), 1);
}
