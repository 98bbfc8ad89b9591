#include <cmath>

#include <Eigen/Geometry>

#include <bench_references/peers.hpp>
#include <bench_support/stopwatch.hpp>

#ifdef BENCH_EMBREE
#include <embree3/rtcore.h>
#endif

namespace bench {

#ifdef BENCH_EMBREE

using Vec = Eigen::Vector3f;

namespace {

/// The closest point of a triangle, by regions of its plane, in float as in Embree.
/// Based on: Christer Ericson. Real-Time Collision Detection. 2005. - section 5.1.5
Vec closest_on_triangle(const Vec& p, const Vec& a, const Vec& b, const Vec& c) {
  const Vec ab = b - a, ac = c - a;
  const float d1 = ab.dot(p - a), d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const float d3 = ab.dot(p - b), d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const float d5 = ab.dot(p - c), d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  return a + vb / (va + vb + vc) * ab + vc / (va + vb + vc) * ac;
}

struct Scene {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  std::vector<float> vertices;
  std::vector<unsigned> indices;

  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Vec vertex(unsigned i) const { return {vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]}; }
};

struct Search {
  const Scene* scene;
  Vec p;
};

bool visit(RTCPointQueryFunctionArguments* args) {
  const auto& search = *static_cast<Search*>(args->userPtr);
  const unsigned* t = &search.scene->indices[3 * args->primID];
  const Vec q = closest_on_triangle(search.p, search.scene->vertex(t[0]), search.scene->vertex(t[1]),
                                    search.scene->vertex(t[2]));
  const float d = (q - search.p).norm();
  if (d >= args->query->radius) return false;
  args->query->radius = d;
  return true;
}

void query_all(const Scene& scene, float reach_m, const Cloud& cloud, std::span<float> distance_m) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Search search{&scene, {cloud.x[i], cloud.y[i], cloud.z[i]}};
    RTCPointQuery query{cloud.x[i], cloud.y[i], cloud.z[i], 0.0f, reach_m};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene.scene, &query, &context, visit, &search);
    distance_m[i] = query.radius;
  }
}

}  // namespace

std::vector<Peer> embree_peers(const bodice::geometry::TriMesh& mesh, double reach_m) {
  auto scene = std::make_shared<Scene>();
  for (const auto& v : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) scene->vertices.push_back(static_cast<float>(v[axis]));
  for (const auto& t : mesh.triangles) scene->indices.insert(scene->indices.end(), t.begin(), t.end());
  scene->vertices.push_back(0.0f);  // Embree reads sixteen bytes a vertex
  RTCGeometry geometry = rtcNewGeometry(scene->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, scene->vertices.data(),
                             0, 12, mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, scene->indices.data(), 0,
                             12, mesh.triangles.size());
  const Stopwatch watch;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene->scene);
  Peer peer;
  peer.name = embree_name(reach_m);
  peer.build_ms = watch.cpu_ms();
  peer.reach_m = reach_m;
  peer.query = [scene, reach_m](const Cloud& cloud, std::span<float> distance_m) {
    query_all(*scene, static_cast<float>(reach_m), cloud, distance_m);
  };
  return {peer};
}

#else

std::vector<Peer> embree_peers(const bodice::geometry::TriMesh&, double) {
  return {};
}

#endif

std::string embree_name(double reach_m) {
  const std::string reach = std::isinf(reach_m)
                                ? "any distance"
                                : "within " + std::to_string(static_cast<int>(1e3 * reach_m)) + " mm";
  return "Embree 3 point query, skin, " + reach;
}

}  // namespace bench
