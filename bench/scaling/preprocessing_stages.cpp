#include <algorithm>
#include <cstdlib>
#include <memory>

#include <bodice/engine/hash.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/fitting/kmeans.hpp>
#include <bodice/fitting/mvee.hpp>
#include <bodice/geodesic/distance.hpp>
#include <bodice/geodesic/edge_graph.hpp>
#include <bodice/synth/body.hpp>
#include "stage.hpp"

namespace bodice_bench {
namespace {

using namespace bodice;
using engine::Context;
using geometry::Vec3;

std::shared_ptr<const synth::Body> make_body(std::size_t vertices) {
  auto body = synth::make_body(Context{}, {.vertices = static_cast<int>(vertices)});
  return std::make_shared<const synth::Body>(std::move(body).value());
}

std::vector<Vec3> random_points(std::size_t count) {
  engine::Random random(17);
  std::vector<Vec3> points(count);
  for (Vec3& point : points) point = Vec3(random.normal(), 2.0 * random.normal(), random.normal());
  return points;
}

}  // namespace

Stage dijkstra_stage() {
  return {"Dijkstra, 16 sources", "vertices", 10'000, 100'000, [](std::size_t size) -> Work {
            const auto body = make_body(size);
            const Context inline_context;
            const auto graph = std::make_shared<const geodesic::EdgeGraph>(geodesic::edge_graph(
                inline_context, body->mesh, geometry::mesh_edges(body->mesh), geodesic::Metric::kEdges));
            std::vector<geometry::Index> sources;
            for (std::size_t i = 0; i < 16; ++i) {
              sources.push_back(static_cast<geometry::Index>(i * graph->vertex_count() / 16));
            }
            return [graph, sources](const Context& context) {
              engine::Hasher hasher;
              for (const auto& field : geodesic::distances_each(context, *graph, sources))
                hasher.add(field.back());
              return hasher.value();
            };
          }};
}

Stage mvee_stage() {
  return {"MVEE, sets of 1000", "points", 32'000, 320'000, [](std::size_t size) -> Work {
            const auto points = std::make_shared<const std::vector<Vec3>>(random_points(size));
            return [points](const Context& context) {
              const std::size_t sets = points->size() / 1000;
              std::vector<double> volumes(sets);
              engine::parallel_for(context, sets, 1, [&](std::size_t set, std::size_t) {
                const auto result = fitting::mvee(std::span(*points).subspan(set * 1000, 1000));
                volumes[set] = result.ellipsoid.radii.prod();
              });
              engine::Hasher hasher;
              hasher.add(std::span<const double>(volumes));
              return hasher.value();
            };
          }};
}

Stage kmeans_stage() {
  return {"K-means, 64 clusters", "points", 10'000, 100'000, [](std::size_t size) -> Work {
            const auto points = std::make_shared<const std::vector<Vec3>>(random_points(size));
            return [points](const Context& context) {
              std::vector<Vec3> centers(points->begin(), points->begin() + 64);
              const auto clusters =
                  fitting::kmeans(context, *points, {}, std::move(centers), {.max_iterations = 10});
              engine::Hasher hasher;
              for (const Vec3& center : clusters.centers) hasher.add(center.sum());
              return hasher.value();
            };
          }};
}

Stage fit_stage() {
  return {"whole fit, paper tier", "vertices", 5'000, 13'000, [](std::size_t size) -> Work {
            const auto body = make_body(size);
            return [body](const Context& context) {
              fitting::FitOptions options;
              options.tier = proxy::Tier::kPaper;
              const auto result = fitting::fit(context, {body->mesh, body->part, body->stature_m}, options);
              return result ? result->proxy.hash() : 0;
            };
          }};
}

}  // namespace bodice_bench
