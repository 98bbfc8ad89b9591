#include "bind/exercises.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/proxy/posed_proxy.hpp>

#include "bind/carry_terms.hpp"
#include "bind/texel_directions.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {
namespace {

using body::Part;

/// The largest distance from the skin at which a carried surface is searched for, meters at the reference
/// stature.
constexpr double kFarthest_m = 0.06;
/// The ellipsoid that owns the skin at a point may lie this far under it, in blends, since its table corrects
/// the difference.
constexpr double kOthersOver = 4.0;

/// A body in an exercise.
struct Exercise {
  const proxy::BodyProxy& proxy;
  const proxy::Binding& binding;
  std::span<const rig::Affine> skinning;
  const geometry::MeshDistance& skin;
  double farthest_m;
};

/// One ellipsoid in an exercise.
class Exercised {
 public:
  Exercised(const Exercise& in, std::size_t k)
      : in_(in), table_(in.proxy.relief()[k]), shape_(in.proxy.ellipsoids()[k].shape) {
    const proxy::Binding& binding = in.binding;
    const std::size_t first = binding.first_term[k];
    map_ = carried(std::span(binding.terms).subspan(first, binding.first_term[k + 1] - first), in.skinning);
    to_normal_ = map_.leftCols<3>().inverse().transpose();
  }

  /// How far the surface at a texel, the ellipsoid's or its table's, is outside of the skin, meters.
  double outside_m(int texel) const {
    const Vec3 direction = texel_direction(texel, table_.nodes_per_side);
    const Vec3 at = rig::apply(map_, surface_point(shape_, direction));
    const Vec3 normal =
        (to_normal_ * (shape_.axes * direction.cwiseQuotient(shape_.radii))).stableNormalized();
    const proxy::ReliefTexel values =
        in_.proxy.texels()[table_.first_texel + static_cast<std::size_t>(texel)];
    const double h = double{table_.h_offset_m} + double{table_.h_scale_m} * values.h / 255.0;
    const Vec3 point = at + std::max(0.0, h) * normal;
    const auto hit = in_.skin.closest_point_within(point, in_.farthest_m);
    return hit && !in_.skin.inside(point) ? std::abs(hit->signed_distance) : 0.0;
  }

 private:
  const Exercise& in_;
  const proxy::ReliefTable& table_;
  const geometry::Ellipsoid& shape_;
  rig::Affine map_;
  geometry::Mat3 to_normal_;
};

/// Returns, for each wanted texel of a table, the largest height above the skin among the texels around it.
/// Heights are sampled in every second row and column.
std::vector<double> outside_around(const Exercised& one, int n, std::span<const std::uint8_t> wanted) {
  const int m = n / 2 + 1;
  const auto at = [n](int i) { return std::min(2 * i, n - 1); };
  std::vector<double> looked(static_cast<std::size_t>(m * m), -1.0);
  std::vector<double> outside_m(wanted.size(), 0.0);
  for (int texel = 0; texel < n * n; ++texel) {
    if (!wanted[static_cast<std::size_t>(texel)]) continue;
    const int column = texel % n, row = texel / n;
    for (int j = row / 2; j <= std::min((row + 1) / 2, m - 1); ++j)
      for (int i = column / 2; i <= std::min((column + 1) / 2, m - 1); ++i) {
        double& found = looked[static_cast<std::size_t>(j * m + i)];
        if (found < 0.0) found = one.outside_m(at(j) * n + at(i));
        outside_m[static_cast<std::size_t>(texel)] =
            std::max(outside_m[static_cast<std::size_t>(texel)], found);
      }
  }
  return outside_m;
}

/// Marks the texels that are buried and are no skin nodes.
std::vector<std::uint8_t> buried_texels(const proxy::ReliefTable& table, const proxy::Binding& binding,
                                        std::size_t k, const Burial& burial) {
  std::vector<std::uint8_t> buried(std::size_t{table.nodes_per_side} * table.nodes_per_side);
  for (std::size_t i = 0; i < buried.size(); ++i) buried[i] = burial.depth[table.first_texel + i] > 0;
  for (std::size_t b = binding.first_bundle[k]; b < binding.first_bundle[k + 1]; ++b)
    for (const std::uint16_t texel : binding.bundles[b].texel) buried[texel] = 0;
  return buried;
}

/// The limbs of one side.
struct Side {
  Part thigh, calf, upper_arm, forearm;
};
constexpr Side kLeft = {Part::kThighL, Part::kCalfL, Part::kUpperArmL, Part::kForearmL};
constexpr Side kRight = {Part::kThighR, Part::kCalfR, Part::kUpperArmR, Part::kForearmR};

/// A seat or a squat: both thighs to the front, both calves back, both arms to the front.
std::vector<Bend> crouch(const Vec3& front, double thigh_deg, double calf_deg, double arm_deg) {
  const Side &l = kLeft, &r = kRight;
  return {{l.thigh, front, thigh_deg, l.thigh},       {r.thigh, front, thigh_deg, r.thigh},
          {l.calf, -front, calf_deg, l.thigh},        {r.calf, -front, calf_deg, r.thigh},
          {l.upper_arm, front, arm_deg, l.upper_arm}, {r.upper_arm, front, arm_deg, r.upper_arm}};
}

/// One leg ahead, the other behind, and the arms against them.
std::vector<Bend> stride_of_run(const Vec3& front, const Side& ahead, const Side& behind) {
  return {{ahead.thigh, front, 60.0, ahead.thigh},          {behind.thigh, -front, 25.0, behind.thigh},
          {ahead.calf, -front, 60.0, ahead.thigh},          {behind.calf, -front, 90.0, behind.thigh},
          {ahead.upper_arm, -front, 40.0, ahead.upper_arm}, {behind.upper_arm, front, 40.0, behind.upper_arm},
          {ahead.forearm, front, 80.0, ahead.upper_arm},    {behind.forearm, front, 80.0, behind.upper_arm}};
}

std::vector<Bend> raised_arms(const Vec3& up) {
  return {{kLeft.upper_arm, up, 120.0, kLeft.upper_arm}, {kRight.upper_arm, up, 120.0, kRight.upper_arm}};
}

}  // namespace

std::vector<std::vector<rig::Affine>> exercises(const SkinnedBody& body, std::span<const Part> part) {
  std::vector<std::vector<rig::Affine>> poses;
  if (part.size() != body.skin.positions.size()) return poses;
  const Limbs limbs(body, part);
  const Vec3 &front = limbs.directions().front, &up = limbs.directions().up;
  const std::vector<Bend> seat = crouch(front, 85.0, 85.0, 30.0), squat = crouch(front, 110.0, 125.0, 80.0);
  for (const std::vector<Bend>& bends : {seat, squat, stride_of_run(front, kLeft, kRight),
                                         stride_of_run(front, kRight, kLeft), raised_arms(up)})
    if (auto skinning = limbs.bent(bends)) poses.push_back(std::move(skinning).value());
  return poses;
}

void raise_burial(const engine::Context& context, const proxy::BodyProxy& proxy,
                  const proxy::Binding& binding, const SkinnedBody& body,
                  std::span<const std::vector<rig::Affine>> exercises, Burial& burial) {
  if (burial.step_m <= 0.0f) return;
  const proxy::ReliefReach reach = proxy::relief_reach(proxy.stature_m());
  const double farthest_m = kFarthest_m * proxy.stature_m() / kReferenceStature_m;
  const geometry::MeshDistance at_rest(context, body.skin);
  geometry::TriMesh skin = body.skin;
  for (const std::vector<rig::Affine>& skinning : exercises) {
    rig::skin_linear(context, body.skin.positions, body.weights, skinning, skin.positions);
    const geometry::MeshDistance distance(context, at_rest, skin);
    const Exercise exercise{proxy, binding, skinning, distance, farthest_m};
    engine::parallel_for(context, proxy.relief().size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const proxy::ReliefTable& table = proxy.relief()[k];
        const std::vector<std::uint8_t> buried = buried_texels(table, binding, k, burial);
        const auto outside_m = outside_around(Exercised(exercise, k), table.nodes_per_side, buried);
        for (std::size_t i = 0; i < buried.size(); ++i) {
          if (outside_m[i] <= 0.0) continue;
          std::uint8_t& depth = burial.depth[table.first_texel + i];
          const double needed_m = (outside_m[i] + kOthersOver * reach.blend_m) / proxy::kBurialWeight;
          depth = static_cast<std::uint8_t>(
              std::clamp(std::ceil(needed_m / double{burial.step_m}), static_cast<double>(depth), 255.0));
        }
      }
    });
  }
}

}  // namespace bodice::binding
