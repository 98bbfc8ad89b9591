// The paper's figures 11 and 12: the time a frame against the number of the body's vertices, and against the
// number of particles, with two trees of triangles beside it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "figures.hpp"
#include "frame_cost.hpp"
#include "subject.hpp"

namespace bench {

using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

namespace {

constexpr int kGarmentVertices = 20000, kEllipsoids = 89;

bodice::proxy::BodyProxy fit(const bodice::synth::Body& body) {
  bodice::fitting::FitOptions options;
  options.tier = bodice::proxy::Tier::kSolid;  // its cost to fit stays bearable at a million vertices
  options.max_ellipsoids = kEllipsoids;
  auto result =
      bodice::fitting::fit({}, {.mesh = body.mesh, .part = body.part, .stature_m = body.stature_m}, options);
  if (!result.ok()) std::puts(result.error().sentence().c_str()), std::exit(1);
  return result->proxy;
}

bool over_body_vertices(std::size_t largest) {
  const TriMesh garment = garment_over(make_subject(kGarmentVertices).mesh);
  Cloud cloud;
  for (const Vec3& p : garment.positions) cloud.add(p);
  std::printf(
      "| body vertices | ellipsoids | proxy, ms a frame | pair of trees, ms | contacts of the trees |\n"
      "|---|---|---|---|---|\n");
  double least = 1e30, most = 0.0;
  for (const std::size_t vertices : {4500u, 13000u, 54000u, 214000u, 856000u}) {
    if (vertices > largest) break;
    const auto body = make_subject(static_cast<int>(vertices));
    const auto proxy = fit(body);
    const double ours = proxy_frame(proxy, cloud).ms;
    const FrameCost trees = tree_frame(body.mesh, garment);
    std::printf("| %zu | %zu | %.3f | %.1f | %zu |\n", body.mesh.positions.size(), proxy.ellipsoids().size(),
                ours, trees.ms, trees.contacts);
    std::fflush(stdout);
    least = std::min(least, ours);
    most = std::max(most, ours);
  }
  std::printf("proxy: largest over smallest %.3f (bar 1.10)\n\n", most / least);
  return most <= 1.1 * least;
}

bool over_particles() {
  const auto body = make_subject(8850);
  const auto proxy = fit(body);
  std::printf("| particles | ms a frame | ns a particle |\n|---|---|---|\n");
  double least = 1e30, most = 0.0;
  for (const std::size_t count : {30000u, 100000u, 300000u, 1000000u}) {
    const double ms = proxy_frame(proxy, near_skin(body.mesh, count, 0.03, 1)).ms;
    const double ns = 1e6 * ms / static_cast<double>(count);
    std::printf("| %zu | %.3f | %.1f |\n", count, ms, ns);
    std::fflush(stdout);
    least = std::min(least, ns);
    most = std::max(most, ns);
  }
  // More particles lie closer together, so that each costs less: linear or better.
  std::printf("ns a particle: largest over smallest %.2f\n", most / least);
  return true;
}

}  // namespace

bool draw_figures(std::size_t largest_body) {
  const bool flat = over_body_vertices(largest_body);
  return over_particles() && flat;
}

}  // namespace bench
