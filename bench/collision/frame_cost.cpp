#include "frame_cost.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include <bench_support/stopwatch.hpp>

#include "triangle_trees.hpp"

namespace bench {

using bodice::geometry::Mat3;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

namespace {

constexpr int kProxyFrames = 14, kTreeFrames = 3;
constexpr double kOver_m = 0.004, kThickness_m = 0.005;

/// A small turn about the vertical, there or back.
Mat3 turn(int frame) {
  return Eigen::AngleAxisd(frame % 2 == 0 ? 0.01 : -0.01, Vec3::UnitY()).toRotationMatrix();
}

void apply(const Mat3& rotation, TriMesh& mesh) {
  for (Vec3& p : mesh.positions) p = rotation * p;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

TriMesh garment_over(const TriMesh& skin) {
  TriMesh garment = skin;
  const std::vector<Vec3> normals = bodice::geometry::vertex_normals(skin);
  for (std::size_t i = 0; i < normals.size(); ++i) garment.positions[i] += kOver_m * normals[i];
  return garment;
}

FrameCost proxy_frame(const bodice::proxy::BodyProxy& proxy, const Cloud& cloud,
                      bodice::collision::Response response) {
  bodice::collision::Collider collider(proxy);
  bodice::collision::Workspace order;
  std::vector<bodice::geometry::Ellipsoid> shapes;
  for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  const Cloud start = local(cloud, collider);
  Cloud now = start;
  FrameCost cost;
  std::vector<double> ms;
  for (int frame = 0; frame < kProxyFrames; ++frame) {
    const Mat3 rotation = turn(frame);
    for (auto& e : shapes) e.center = rotation * e.center, e.axes = rotation * e.axes;
    now = start;
    const Stopwatch watch;
    collider.move_to(shapes, 1.0 / 60.0);
    const auto report = collider.resolve(
        {}, now.particles(), {.response = response, .thickness_m = static_cast<float>(kThickness_m)}, order);
    if (frame > 1) ms.push_back(watch.cpu_ms());
    cost.contacts = report.contacts;
  }
  cost.ms = median(std::move(ms));
  return cost;
}

FrameCost tree_frame(TriMesh body, TriMesh garment) {
  TriangleTree body_tree(body), garment_tree(garment);
  FrameCost cost;
  std::vector<double> ms;
  for (int frame = 0; frame < kTreeFrames; ++frame) {
    apply(turn(frame), body);
    apply(turn(frame), garment);
    const Stopwatch watch;
    body_tree.refit();
    garment_tree.refit();
    cost.contacts = garment_tree.count_contacts(body_tree, kThickness_m);
    ms.push_back(watch.cpu_ms());
  }
  cost.ms = median(std::move(ms));
  return cost;
}

}  // namespace bench
