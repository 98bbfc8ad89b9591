#include "frame_times.hpp"

#include <bench_references/frame_cost.hpp>
#include <bench_references/subject.hpp>

namespace paper_bench {
namespace {

using bodice::collision::Response;
using bodice::geometry::MeshDistance;
using bodice::proxy::BodyProxy;
using bodice::proxy::Tier;

constexpr int kBodyVertices = 8850, kEllipsoids = 89;  // the paper's Female 2

/// A body with the proxies of both tiers.
struct Body {
  bodice::synth::Body body;
  BodyProxy paper, solid;
};

Body prepare(int vertices) {
  auto body = bench::make_subject(vertices);
  const MeshDistance distance({}, body.mesh);
  auto paper = bench::fit_subject(body, distance, Tier::kPaper, kEllipsoids, 0.0);
  auto solid = bench::fit_subject(body, distance, Tier::kSolid, kEllipsoids, 0.0);
  return {std::move(body), std::move(paper), std::move(solid)};
}

FrameTimes measure(const Body& body, const bodice::geometry::TriMesh& garment) {
  bench::Cloud cloud;
  for (const auto& p : garment.positions) cloud.add(p);
  const bench::FrameCost trees = bench::tree_frame(body.body.mesh, garment);
  return {.body_vertices = body.body.mesh.positions.size(),
          .particles = cloud.size(),
          .ellipsoids = body.paper.ellipsoids().size(),
          .paper_ms = bench::proxy_frame(body.paper, cloud, Response::kPaper).ms,
          .solid_ms = bench::proxy_frame(body.solid, cloud).ms,
          .trees_ms = trees.ms,
          .tree_contacts = trees.contacts};
}

}  // namespace

std::vector<FrameTimes> over_body_vertices(std::span<const int> body_vertices, int particles,
                                           const Progress& progress) {
  const auto garment = bench::garment_over(bench::make_subject(particles).mesh);
  std::vector<FrameTimes> rows;
  for (const int vertices : body_vertices) {
    progress("figure 11: a body of " + std::to_string(vertices) + " vertices");
    rows.push_back(measure(prepare(vertices), garment));
  }
  return rows;
}

std::vector<FrameTimes> over_particles(std::span<const int> particles, const Progress& progress) {
  const Body body = prepare(kBodyVertices);
  std::vector<FrameTimes> rows;
  for (const int count : particles) {
    progress("figure 12: " + std::to_string(count) + " particles");
    rows.push_back(measure(body, bench::garment_over(bench::make_subject(count).mesh)));
  }
  return rows;
}

bench::Table frame_table(const std::string& name, const std::string& caption,
                         const std::vector<FrameTimes>& rows) {
  bench::Table table(name, caption,
                     {"body vertices", "particles", "ellipsoids", "paper's tier and response_ms",
                      "exact response on solid_ms", "pair of trees_ms", "contacts of the trees",
                      "trees over exact response_timed"});
  for (const FrameTimes& row : rows)
    table.add({row.body_vertices, row.particles, row.ellipsoids, row.paper_ms, row.solid_ms, row.trees_ms,
               row.tree_contacts, row.trees_ms / row.solid_ms});
  return table;
}

bench::Plot frame_plot(const std::string& title, bool over_bodies, const std::vector<FrameTimes>& rows) {
  bench::Plot plot{.title = title,
                   .x_label = over_bodies ? "vertices of the body" : "particles of the garment",
                   .y_label = "ms a frame",
                   .footer = {},
                   .series = {{"paper's tier, response", {}, true, false},
                              {"solid, exact response", {}, true, false},
                              {"pair of trees", {}, true, true}}};
  for (const FrameTimes& row : rows) {
    const auto x = static_cast<double>(over_bodies ? row.body_vertices : row.particles);
    plot.series[0].points.push_back({x, row.paper_ms, {}});
    plot.series[1].points.push_back({x, row.solid_ms, {}});
    plot.series[2].points.push_back({x, row.trees_ms, {}});
  }
  return plot;
}

}  // namespace paper_bench
