#include <cmath>

#include <bench_references/frame_cost.hpp>
#include <bench_references/peers.hpp>
#include <bench_support/stopwatch.hpp>

#ifdef BENCH_FCL
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#endif

namespace bench {

#ifdef BENCH_FCL

namespace {

using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

/// FCL takes tens of microseconds a particle.
constexpr std::size_t kOneOf = 50;

std::vector<fcl::Triangle> triangles_of(const TriMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  return triangles;
}

template <class Boxes>
std::shared_ptr<fcl::BVHModel<Boxes>> model_of(const TriMesh& mesh) {
  auto model = std::make_shared<fcl::BVHModel<Boxes>>();
  model->beginModel();
  model->addSubModel(mesh.positions, triangles_of(mesh));
  model->endModel();
  return model;
}

/// A triangle so small that its distance is that of its position. FCL has distances between shapes only, and
/// finds nearest triangles of two trees faster than those of a ball and a tree.
std::shared_ptr<fcl::BVHModel<fcl::RSSd>> speck() {
  constexpr double kSize_m = 1e-7;
  auto model = std::make_shared<fcl::BVHModel<fcl::RSSd>>();
  model->beginModel();
  model->addTriangle(Vec3::Zero(), kSize_m * Vec3::UnitX(), kSize_m * Vec3::UnitY());
  model->endModel();
  return model;
}

fcl::Transform3d at(const Vec3& position) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = position;
  return pose;
}

}  // namespace

std::vector<Peer> fcl_peers(const TriMesh& mesh) {
  const Stopwatch watch;
  const auto skin = model_of<fcl::RSSd>(mesh);
  Peer peer;
  peer.name = "FCL tree of swept spheres, skin, any distance";
  peer.build_ms = watch.cpu_ms();
  peer.one_of = kOneOf;
  peer.query = [skin, triangle = speck()](const Cloud& cloud, std::span<float> distance_m) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      fcl::DistanceResult<double> found;
      fcl::distance(skin.get(), fcl::Transform3d::Identity(), triangle.get(), at(cloud.at(i)),
                    fcl::DistanceRequest<double>(), found);
      distance_m[i] = static_cast<float>(found.min_distance);
    }
  };
  return {peer};
}

std::optional<FrameCost> fcl_frame(TriMesh body, const TriMesh& garment) {
  // This is the fastest of FCL's trees for balls; the tree of axis-aligned boxes copies the mesh for each
  // query.
  const auto skin = model_of<fcl::OBBd>(body);
  const fcl::Sphered ball(kFrameThickness_m);
  const fcl::CollisionRequest<double> whether(1, false);
  for (Vec3& p : body.positions) p = frame_turn(0) * p;
  FrameCost cost;
  const Stopwatch watch;
  skin->beginReplaceModel();
  skin->replaceSubModel(body.positions);
  skin->endReplaceModel(true, true);
  for (const Vec3& p : garment.positions) {
    fcl::CollisionResult<double> found;
    fcl::collide(skin.get(), fcl::Transform3d::Identity(), &ball, at(frame_turn(0) * p), whether, found);
    cost.contacts += found.isCollision();
  }
  cost.ms = watch.cpu_ms();
  return cost;
}

#else

std::vector<Peer> fcl_peers(const bodice::geometry::TriMesh&) {
  return {};
}

std::optional<FrameCost> fcl_frame(bodice::geometry::TriMesh, const bodice::geometry::TriMesh&) {
  return std::nullopt;
}

#endif

}  // namespace bench
