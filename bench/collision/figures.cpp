// The paper's figures 11 and 12: the time a frame against the number of the body's vertices, and against the
// number of particles, with two trees of triangles beside it. A frame moves the body, refits what has to be
// refitted, and finds or resolves the contacts of a garment that lies 4 mm over the skin.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <Eigen/Geometry>

#include "figures.hpp"
#include "peers.hpp"
#include "subject.hpp"
#include "triangle_trees.hpp"

namespace bench {

using bodice::geometry::Mat3;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

namespace {

constexpr int kGarmentVertices = 20000, kEllipsoids = 89, kFrames = 7;
constexpr double kOver_m = 0.004, kThickness_m = 0.005;

TriMesh garment_over(const TriMesh& skin) {
  TriMesh garment = skin;
  const std::vector<Vec3> normals = bodice::geometry::vertex_normals(skin);
  for (std::size_t i = 0; i < normals.size(); ++i) garment.positions[i] += kOver_m * normals[i];
  return garment;
}

/// A small turn about the vertical, there or back.
Mat3 turn(int frame) {
  return Eigen::AngleAxisd(frame % 2 == 0 ? 0.01 : -0.01, Vec3::UnitY()).toRotationMatrix();
}

void apply(const Mat3& rotation, TriMesh& mesh) {
  for (Vec3& p : mesh.positions) p = rotation * p;
}

struct Frames {
  std::vector<double> ms;
  double median() {
    std::sort(ms.begin(), ms.end());
    return ms[ms.size() / 2];
  }
};

/// Ours: move the proxy, resolve every particle of the cloud.
double proxy_frame_ms(const bodice::proxy::BodyProxy& proxy, const Cloud& cloud) {
  bodice::collision::Collider collider(proxy);
  bodice::collision::Workspace order;
  std::vector<bodice::geometry::Ellipsoid> shapes;
  for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  const Cloud start = local(cloud, collider);
  Cloud now = start;
  Frames frames;
  for (int frame = 0; frame < 2 * kFrames; ++frame) {
    const Mat3 rotation = turn(frame);
    for (auto& e : shapes) e.center = rotation * e.center, e.axes = rotation * e.axes;
    now = start;
    const double begin = cpu_s();
    collider.move_to(shapes, 1.0 / 60.0);
    collider.resolve({}, now.particles(), {.thickness_m = static_cast<float>(kThickness_m)}, order);
    if (frame > 1) frames.ms.push_back(1e3 * (cpu_s() - begin));
  }
  return frames.median();
}

double tree_frame_ms(TriMesh body, TriMesh garment, std::size_t& contacts) {
  TriangleTree body_tree(body), garment_tree(garment);
  Frames frames;
  for (int frame = 0; frame < 3; ++frame) {
    apply(turn(frame), body);
    apply(turn(frame), garment);
    const double begin = cpu_s();
    body_tree.refit();
    garment_tree.refit();
    contacts = garment_tree.count_contacts(body_tree, kThickness_m);
    frames.ms.push_back(1e3 * (cpu_s() - begin));
  }
  return frames.median();
}

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
    const double ours = proxy_frame_ms(proxy, cloud);
    std::size_t contacts = 0;
    const double trees = tree_frame_ms(body.mesh, garment, contacts);
    std::printf("| %zu | %zu | %.3f | %.1f | %zu |\n", body.mesh.positions.size(), proxy.ellipsoids().size(),
                ours, trees, contacts);
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
    const double ms = proxy_frame_ms(proxy, near_skin(body.mesh, count, 0.03, 1));
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
