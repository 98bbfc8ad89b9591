// The paper's figures 11 and 12: time of a frame over the number of the body's vertices, and over the number
// of particles. Two trees of triangles and FCL are measured beside the proxies. The proxies take turns, and
// the least frame counts.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

#include <bench_references/frame_cost.hpp>
#include <bench_references/subject.hpp>
#include "figures.hpp"

namespace bench {

using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

namespace {

constexpr int kGarmentVertices = 20000, kEllipsoids = 89, kFrames = 24;
constexpr double kOver_m = 0.004;

bodice::proxy::BodyProxy fit(const bodice::synth::Body& body) {
  bodice::fitting::FitOptions options;
  options.tier = bodice::proxy::Tier::kSolid;  // fits in bearable time even at a million vertices
  options.max_ellipsoids = kEllipsoids;
  auto result =
      bodice::fitting::fit({}, {.mesh = body.mesh, .part = body.part, .stature_m = body.stature_m}, options);
  if (!result.ok()) std::puts(result.error().sentence().c_str()), std::exit(1);
  return result->proxy;
}

/// Points 4 mm over the closest points of the proxy's surface. Over one common skin the proxies of coarse
/// bodies would have other contacts than those of fine ones, because their flat triangles miss the skin by
/// millimeters.
Cloud over(const bodice::proxy::BodyProxy& proxy, const Cloud& points) {
  const bodice::collision::Collider collider(proxy);
  Cloud start = local(points, collider), result;
  std::vector<bodice::collision::Contact> nearest(start.size());
  collider.query({}, start.particles(), nearest);
  const auto vec = [](const float(&v)[3]) { return Vec3(double{v[0]}, double{v[1]}, double{v[2]}); };
  for (const auto& contact : nearest)
    result.add(collider.origin() + vec(contact.point) + kOver_m * vec(contact.normal));
  return result;
}

/// Runs the frames of all proxies in turns.
void run(std::vector<ProxyFrames>& all) {
  for (int frame = 0; frame < kFrames; ++frame)
    for (ProxyFrames& one : all) one.run();
}

bool over_body_vertices(std::size_t largest) {
  const TriMesh garment = garment_over(make_subject(kGarmentVertices).mesh);
  Cloud cloud;
  for (const Vec3& p : garment.positions) cloud.add(p);
  std::vector<ProxyFrames> ours;
  std::vector<std::size_t> vertices;
  std::vector<FrameCost> trees;
  std::vector<std::optional<FrameCost>> fcl;
  for (const std::size_t count : {4500u, 13000u, 54000u, 214000u, 856000u}) {
    if (count > largest) break;
    const auto body = make_subject(static_cast<int>(count));
    const auto proxy = fit(body);
    ours.emplace_back(proxy, over(proxy, cloud));
    vertices.push_back(body.mesh.positions.size());
    trees.push_back(tree_frame(body.mesh, garment));
    fcl.push_back(fcl_frame(body.mesh, garment));
  }
  run(ours);
  if (!fcl.front()) std::puts("FCL is not installed here: not measured");
  std::puts(
      "| body vertices | ellipsoids | proxy, least ms a frame | contacts | judged in double | pair of trees, "
      "ms | "
      "contacts of the trees | FCL, ms | contacts of FCL |\n|---|---|---|---|---|---|---|---|---|");
  double least = 1e30, most = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double ms = ours[i].sorted_ms().front();
    std::printf("| %zu | %zu | %.3f | %zu | %zu | %.1f | %zu |", vertices[i], ours[i].ellipsoids(), ms,
                ours[i].contacts(), ours[i].judged_exactly(), trees[i].ms, trees[i].contacts);
    fcl[i] ? std::printf(" %.0f | %zu |\n", fcl[i]->ms, fcl[i]->contacts) : std::printf(" | |\n");
    least = std::min(least, ms);
    most = std::max(most, ms);
  }
  std::printf("proxy: largest over smallest %.3f (bar 1.10)\n\n", most / least);
  return most <= 1.1 * least;
}

bool over_particles() {
  const auto body = make_subject(8850);
  const auto proxy = fit(body);
  std::vector<ProxyFrames> ours;
  for (const std::size_t count : {30000u, 100000u, 300000u, 1000000u})
    ours.emplace_back(proxy, near_skin(body.mesh, count, 0.03, 1));
  run(ours);
  std::printf("| particles | least ms a frame | ns a particle |\n|---|---|---|\n");
  std::vector<double> ns;
  for (const ProxyFrames& one : ours) {
    const double ms = one.sorted_ms().front();
    ns.push_back(1e6 * ms / static_cast<double>(one.particles()));
    std::printf("| %zu | %.3f | %.1f |\n", one.particles(), ms, ns.back());
  }
  // More particles lie closer together, so that each costs less: the growth is linear or slower.
  std::printf("ns a particle: of the most over the fewest %.2f (bar 1.10)\n", ns.back() / ns.front());
  return ns.back() <= 1.1 * ns.front();
}

}  // namespace

bool draw_figures(std::size_t largest_body) {
  const bool flat = over_body_vertices(largest_body);
  return over_particles() && flat;
}

}  // namespace bench
