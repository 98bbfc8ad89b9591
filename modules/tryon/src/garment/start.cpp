#include "garment/start.hpp"

#include <algorithm>
#include <utility>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/triangle.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

/// Contact moves shallower vertices out within a frame, without a jerk.
constexpr double kWorthLifting_m = 0.015;
/// The longest lift. The widest proxies stand out by half of it (`solid`, 108 mm), and a longer path would
/// lead through another limb.
constexpr double kLongestLift_m = 0.2;
constexpr int kSteps = 64;
constexpr double kArrived_m = 1e-5;
constexpr std::size_t kStartGrain = 256;  // vertices a block

double distance_of(const collision::Collider& collider, const Vec3& world) {
  const Eigen::Vector3f local = (world - collider.origin()).cast<float>();
  return double{collider.query({local.x(), local.y(), local.z()}).signed_distance};
}

/// The normal at a point of the skin, interpolated between the corners of the triangle that the point lies
/// in.
Vec3 normal_at(const geometry::TriMesh& skin, const std::vector<Vec3>& normals,
               const geometry::SurfacePoint& at) {
  const auto& t = skin.triangles[at.triangle];
  const Vec3 share =
      geometry::closest_point(skin.positions[t[0]], skin.positions[t[1]], skin.positions[t[2]], at.point)
          .barycentric;
  return (share[0] * normals[t[0]] + share[1] * normals[t[1]] + share[2] * normals[t[2]]).stableNormalized();
}

/// The length of the path along a direction until it leaves the proxy, meters; 0 if it does not within
/// kLongestLift_m.
double exit_path_m(const collision::Collider& collider, const Vec3& from, const Vec3& direction,
                   double thickness_m) {
  double path_m = 0.0;
  for (int step = 0; step < kSteps && path_m <= kLongestLift_m; ++step) {
    const double missing_m = thickness_m - distance_of(collider, from + path_m * direction);
    if (missing_m <= kArrived_m) return path_m;
    path_m += std::max(missing_m, kArrived_m);
  }
  return 0.0;
}

/// The garment's positions after the move; empty if none begins deep inside.
std::vector<Vec3> lifted_positions(const engine::Context& context, const geometry::TriMesh& garment,
                                   const SegmentedSkin& body, const collision::Collider& collider,
                                   double thickness_m) {
  std::vector<Vec3> lifted = garment.positions;
  std::vector<double> depth_m(lifted.size(), 0.0);
  engine::parallel_for(context, lifted.size(), kStartGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      if (lifted[v].allFinite()) depth_m[v] = thickness_m - distance_of(collider, lifted[v]);
  });
  if (std::ranges::none_of(depth_m, [](double depth) { return depth > kWorthLifting_m; })) return {};
  const std::vector<Vec3> normals = geometry::vertex_normals(body.input.skin);
  engine::parallel_for(context, lifted.size(), kStartGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (!(depth_m[v] > 0.0)) continue;
      const Vec3 direction = normal_at(body.input.skin, normals, body.distance->closest_point(lifted[v]));
      lifted[v] += exit_path_m(collider, lifted[v], direction, thickness_m) * direction;
    }
  });
  return lifted;
}

}  // namespace

double lift_out(const engine::Context& context, const SegmentedSkin& skin,
                const collision::Collider& collider, double thickness_m, Wardrobe& wardrobe,
                cloth::Solver& solver) {
  std::vector<Vec3> lifted = lifted_positions(context, wardrobe.mesh, skin, collider, thickness_m);
  double farthest_m = 0.0;
  for (std::size_t v = 0; v < lifted.size(); ++v)
    farthest_m = std::max(farthest_m, (lifted[v] - wardrobe.mesh.positions[v]).norm());
  if (farthest_m == 0.0) return 0.0;
  if (!solver.set_positions(lifted)) return 0.0;  // a position that is not finite: the garment stays
  wardrobe.mesh.positions = std::move(lifted);
  return farthest_m;
}

}  // namespace bodice::tryon
