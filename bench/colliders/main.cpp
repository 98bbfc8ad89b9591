// The error of colliders on the bodies of a folder (OBJ) beside one naive capsule a part, as Markdown.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <bodice/colliders/reduce.hpp>
#include <bodice/engine/executor.hpp>
#include <bodice/tryon/prepare.hpp>

#include <bench_references/capsules.hpp>
#include <bench_support/help.hpp>

namespace {

using namespace bodice;
using colliders::PlainShape;
using colliders::ShapeKind;

struct Row {
  std::string name;
  std::vector<colliders::SurfaceError> of_body;
};

std::vector<PlainShape> naive(const geometry::TriMesh& mesh, std::span<const body::Part> part) {
  std::vector<PlainShape> shapes;
  for (const bench::Capsule& c : bench::fit_capsules(mesh, part)) {
    const geometry::Vec3 start(double{c.start[0]}, double{c.start[1]}, double{c.start[2]});
    const geometry::Vec3 along(double{c.along[0]}, double{c.along[1]}, double{c.along[2]});
    shapes.push_back({start, start + along, double{c.radius}, double{c.radius}, body::Part::kHead, -1});
  }
  return shapes;
}

bool measure(const engine::Context& context, const std::filesystem::path& file, std::vector<Row>& rows) {
  auto skin = tryon::segment_file(context, file, {});
  if (!skin) {
    std::fprintf(stderr, "%s\n", skin.error().sentence().c_str());
    return false;
  }
  const auto body = tryon::fit_proxy(context, std::move(skin).value(), {});
  if (!body) {
    std::fprintf(stderr, "%s\n", body.error().sentence().c_str());
    return false;
  }
  const proxy::BodyProxy& proxy = body->fit.proxy;
  const geometry::TriMesh& mesh = body->skin.input.skin;
  const colliders::SkinPoints points = colliders::skin_points(context, proxy, mesh);
  const auto add = [&](std::size_t row, std::span<const PlainShape> shapes) {
    rows[row].of_body.push_back(colliders::cost_of(context, proxy, points, shapes).whole);
  };
  add(0, naive(mesh, body->skin.anatomy.part));
  const std::pair<ShapeKind, int> wanted[] = {{ShapeKind::kCapsule, 15},
                                              {ShapeKind::kSphere, 32},
                                              {ShapeKind::kCapsule, 32},
                                              {ShapeKind::kTaperedCapsule, 16},
                                              {ShapeKind::kTaperedCapsule, 32}};
  for (std::size_t i = 0; i < std::size(wanted); ++i) {
    const auto shapes = colliders::reduce(context, proxy, points, wanted[i].first, wanted[i].second);
    if (!shapes) return false;
    add(i + 1, *shapes);
  }
  rows.back().of_body.push_back(colliders::cost_of_ellipsoids(context, proxy, points).whole);
  return true;
}

double mean_mm(const Row& row, double colliders::SurfaceError::*value) {
  double sum = 0.0;
  for (const colliders::SurfaceError& error : row.of_body) sum += error.*value;
  return 1e3 * sum / static_cast<double>(row.of_body.size());
}

constexpr const char* kUsage =
    "colliders DIR\n"
    "The error of colliders for engines on the bodies of a folder (OBJ), beside one naive capsule a part, as "
    "Markdown.\n";

}  // namespace

int main(int argc, char** argv) {
  if (bench::help_requested(argc, argv, kUsage)) return 0;
  if (argc != 2) {
    std::fprintf(stderr, "colliders: name a folder of bodies (OBJ).\n");
    return 2;
  }
  const auto executor = engine::make_tbb_executor(0);
  engine::Context context;
  context.executor = executor.get();
  std::vector<Row> rows = {{"naive capsules, one a part", {}},
                           {"15 capsules", {}},
                           {"32 spheres", {}},
                           {"32 capsules", {}},
                           {"16 tapered capsules", {}},
                           {"32 tapered capsules", {}},
                           {"ellipsoids of `tight`", {}}};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1]))
    if (entry.path().extension() == ".obj") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const auto& file : files)
    if (!measure(context, file, rows)) return 1;
  if (files.empty()) return 1;
  std::printf(
      "| collider, %zu bodies | mean | 95 %% within | worst | worst body's mean |\n|---|---|---|---|---|\n",
      files.size());
  for (const Row& row : rows) {
    double worst = 0.0;
    for (const colliders::SurfaceError& error : row.of_body) worst = std::max(worst, error.mean_m);
    std::printf("| %s | %.1f mm | %.1f mm | %.0f mm | %.1f mm |\n", row.name.c_str(),
                mean_mm(row, &colliders::SurfaceError::mean_m), mean_mm(row, &colliders::SurfaceError::p95_m),
                mean_mm(row, &colliders::SurfaceError::worst_m), 1e3 * worst);
  }
  return 0;
}
