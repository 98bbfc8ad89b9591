#include <cmath>

#include <bench_references/peers.hpp>
#include <bench_support/stopwatch.hpp>

#ifdef BENCH_CGAL
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#endif

namespace bench {

#ifdef BENCH_CGAL

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

struct Scene {
  Triangles triangles;
  Tree tree;
};

Kernel::Point_3 point(const bodice::geometry::Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

std::vector<Peer> cgal_peers(const bodice::geometry::TriMesh& mesh) {
  auto scene = std::make_shared<Scene>();
  for (const auto& t : mesh.triangles)
    scene->triangles.emplace_back(point(mesh.positions[t[0]]), point(mesh.positions[t[1]]),
                                  point(mesh.positions[t[2]]));
  const Stopwatch watch;
  scene->tree.insert(scene->triangles.cbegin(), scene->triangles.cend());
  scene->tree.build();
  scene->tree.accelerate_distance_queries();
  Peer peer;
  peer.name = "CGAL AABB tree, skin, any distance";
  peer.build_ms = watch.cpu_ms();
  peer.query = [scene](const Cloud& cloud, std::span<float> distance_m) {
    for (std::size_t i = 0; i < cloud.size(); ++i)
      distance_m[i] = static_cast<float>(std::sqrt(scene->tree.squared_distance(point(cloud.at(i)))));
  };
  return {peer};
}

#else

std::vector<Peer> cgal_peers(const bodice::geometry::TriMesh&) {
  return {};
}

#endif

}  // namespace bench
