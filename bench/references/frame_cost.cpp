#include <bench_references/frame_cost.hpp>

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include <bench_support/median.hpp>
#include <bench_support/stopwatch.hpp>

#include <bench_references/triangle_trees.hpp>

namespace bench {

using bodice::geometry::Mat3;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

namespace {

constexpr int kProxyFrames = 14, kTreeFrames = 3;
constexpr double kOver_m = 0.004;

void apply(const Mat3& rotation, TriMesh& mesh) {
  for (Vec3& p : mesh.positions) p = rotation * p;
}

}  // namespace

Mat3 frame_turn(int frame) {
  return Eigen::AngleAxisd(frame % 2 == 0 ? 0.01 : -0.01, Vec3::UnitY()).toRotationMatrix();
}

TriMesh garment_over(const TriMesh& skin) {
  TriMesh garment = skin;
  const std::vector<Vec3> normals = bodice::geometry::vertex_normals(skin);
  for (std::size_t i = 0; i < normals.size(); ++i) garment.positions[i] += kOver_m * normals[i];
  return garment;
}

ProxyFrames::ProxyFrames(const bodice::proxy::BodyProxy& proxy, const Cloud& cloud,
                         bodice::collision::Response response)
    : collider_(proxy), response_(response), start_(local(cloud, collider_)), now_(start_) {
  for (const auto& e : proxy.ellipsoids()) shapes_.push_back(e.shape);
}

void ProxyFrames::run() {
  const Mat3 rotation = frame_turn(frame_);
  for (auto& e : shapes_) e.center = rotation * e.center, e.axes = rotation * e.axes;
  now_ = start_;
  const Stopwatch watch;
  collider_.move_to(shapes_, 1.0 / 60.0);
  const auto report = collider_.resolve(
      {}, now_.particles(), {.response = response_, .thickness_m = static_cast<float>(kFrameThickness_m)},
      order_);
  const double ms = watch.cpu_ms();
  if (frame_++ > 1) ms_.push_back(ms);
  contacts_ = report.contacts;
  judged_exactly_ = report.judged_exactly;
}

std::vector<double> ProxyFrames::sorted_ms() const {
  std::vector<double> ms = ms_;
  std::sort(ms.begin(), ms.end());
  return ms;
}

FrameCost proxy_frame(const bodice::proxy::BodyProxy& proxy, const Cloud& cloud,
                      bodice::collision::Response response) {
  ProxyFrames frames(proxy, cloud, response);
  for (int frame = 0; frame < kProxyFrames; ++frame) frames.run();
  return {median(frames.sorted_ms()), frames.contacts()};
}

FrameCost tree_frame(TriMesh body, TriMesh garment) {
  TriangleTree body_tree(body), garment_tree(garment);
  FrameCost cost;
  std::vector<double> ms;
  for (int frame = 0; frame < kTreeFrames; ++frame) {
    apply(frame_turn(frame), body);
    apply(frame_turn(frame), garment);
    const Stopwatch watch;
    body_tree.refit();
    garment_tree.refit();
    cost.contacts = garment_tree.count_contacts(body_tree, kFrameThickness_m);
    ms.push_back(watch.cpu_ms());
  }
  cost.ms = median(std::move(ms));
  return cost;
}

}  // namespace bench
