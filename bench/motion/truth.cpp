#include "truth.hpp"

#include <cmath>
#include <limits>

#include <Eigen/LU>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/sampling.hpp>
#include <bodice/geometry/triangle.hpp>

namespace bench {
namespace {

using namespace bodice;
using geometry::Vec3;

constexpr std::size_t kOnSkinOneOf = 3;       // so many points near the skin for one on it
constexpr std::size_t kInteriorTries = 6000;  // a tenth to a fifth of a body's box is inside
constexpr double kOver_m = 3e-4;              // where a layer above the skin is looked for
constexpr double kTwoLayers = 1.5;            // a winding number

/// The exact distance at a point; not a number where it has no meaning.
double true_distance_m(const geometry::MeshDistance& skin, const Vec3& point) {
  const geometry::SurfacePoint nearest = skin.closest_point(point);
  const bool overlapped =
      skin.winds_more_than(kTwoLayers, point) || skin.inside(nearest.point + kOver_m * nearest.normal);
  return overlapped ? std::numeric_limits<double>::quiet_NaN() : nearest.signed_distance;
}

}  // namespace

std::vector<Vec3> pose_by_definition(const rig::Rig& rig, std::span<const Vec3> rest,
                                     std::span<const rig::Affine> world) {
  std::vector<Eigen::Matrix4d> skinning;
  for (std::size_t j = 0; j < world.size(); ++j) {
    Eigen::Matrix4d now = Eigen::Matrix4d::Identity(), bind = now;
    now.topRows<3>() = world[j];
    bind.topRows<3>() = rig.skeleton.joints[j].bind;
    skinning.push_back(now * bind.inverse());
  }
  std::vector<Vec3> posed;
  for (std::size_t v = 0; v < rest.size(); ++v) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (std::uint32_t e = rig.weights.first[v]; e < rig.weights.first[v + 1]; ++e)
      sum += double{rig.weights.weight[e]} * (skinning[rig.weights.joint[e]] * rest[v].homogeneous());
    posed.push_back(sum.head<3>());
  }
  return posed;
}

TruePoints::TruePoints(const geometry::TriMesh& rest, std::size_t count) {
  const engine::Random random(2027);
  const auto points = geometry::sample_surface(rest, count, 91);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const geometry::Index t = points[i].triangle;
    const geometry::TrianglePoint at =
        geometry::closest_point(rest.corner(t, 0), rest.corner(t, 1), rest.corner(t, 2), points[i].point);
    samples_.push_back({t, at.barycentric, kNear_m * (2.0 * random.uniform_at(i) - 1.0)});
  }
}

Truth TruePoints::in_pose(const engine::Context& context, const geometry::TriMesh& posed) const {
  const geometry::MeshDistance skin(context, posed);
  const geometry::Box box = geometry::bounding_box(posed.positions);
  const engine::Random random(403);
  const std::size_t near_end = samples_.size(), skin_end = near_end + samples_.size() / kOnSkinOneOf;
  std::vector<Vec3> point(skin_end + kInteriorTries);
  std::vector<double> distance(point.size());
  engine::parallel_for(context, point.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i >= skin_end) {
        const std::size_t k = 3 * (i - skin_end);
        point[i] = box.low + Vec3(random.uniform_at(k), random.uniform_at(k + 1), random.uniform_at(k + 2))
                                 .cwiseProduct(box.size());
        distance[i] = skin.inside(point[i]) ? true_distance_m(skin, point[i]) : 1.0;
        continue;
      }
      const Sample& s = samples_[i < near_end ? i : (i - near_end) * kOnSkinOneOf];
      point[i] = s.weight[0] * posed.corner(s.triangle, 0) + s.weight[1] * posed.corner(s.triangle, 1) +
                 s.weight[2] * posed.corner(s.triangle, 2);
      if (i < near_end) point[i] += s.offset_m * geometry::area_vector(posed, s.triangle).stableNormalized();
      distance[i] = true_distance_m(skin, point[i]);
    }
  });
  Truth truth;
  for (std::size_t i = 0; i < point.size(); ++i) {
    const bool keep = i >= skin_end ? distance[i] < 0.0 : std::abs(distance[i]) <= kNear_m;
    if (!keep) continue;  // a distance without meaning is not kept either
    truth.particles.add(point[i]);
    truth.distance_m.push_back(distance[i]);
    truth.near_skin += i < near_end;
    truth.on_skin += i >= near_end && i < skin_end;
  }
  return truth;
}

}  // namespace bench
