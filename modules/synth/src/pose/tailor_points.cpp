#include "pose/tailor_points.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::synth {
namespace {

using body::LandmarkId;
using geometry::Index;

/// The underbust lies kUnderbustDrop below the chest line, and the level of the seat kSeatRise above the
/// crotch, in statures.
constexpr double kUnderbustDrop = 0.036, kSeatRise = 0.045;
/// Half the distance of the bust points from each other, in statures.
constexpr double kBustHalf = 0.04;
/// The depth of the side of the neck's base below C7, in statures.
constexpr double kNeckSideDrop = 0.012;

/// The point where a ray meets a triangle: barycentric weights of its corners, and the distance along the
/// ray.
struct Hit {
  Vec3 weight = Vec3::Zero();
  double distance = -1.0;
};

// Based on: Tomas Moeller, Ben Trumbore. Fast, minimum storage ray/triangle intersection. 1997.
Hit meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& origin, const Vec3& direction) {
  const Vec3 e1 = b - a, e2 = c - a, p = direction.cross(e2);
  const double det = e1.dot(p);
  if (std::abs(det) < 1e-15) return {};
  const Vec3 t = origin - a, q = t.cross(e1);
  const double u = t.dot(p) / det, v = direction.dot(q) / det;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return {};
  return {{1.0 - u - v, u, v}, e2.dot(q) / det};
}

bool all_in(const Posed& b, const geometry::Triangle& t, std::initializer_list<Region> regions) {
  return std::ranges::all_of(t, [&](Index v) {
    return std::find(regions.begin(), regions.end(), b.mesh.region[v]) != regions.end();
  });
}

bool on_trunk_or_leg(const Posed& b, const geometry::Triangle& t) {
  return all_in(b, t, {Region::kTrunk, Region::kCrotch, Region::kLegL, Region::kLegR});
}

/// The centroid of the curve in which a level of the rest pose cuts the trunk, as the pose moves it.
Vec3 level_center(const Posed& b, double height) {
  Vec3 moment = Vec3::Zero();
  double all = 0.0;
  walk_section(b, Vec3(0.0, height, 0.0), Vec3::UnitY(), [&](const Vec3& one, const Vec3& other) {
    const double length = (other - one).norm();
    moment += length * 0.5 * (one + other);
    all += length;
  });
  return all > 0.0 ? Vec3(moment / all) : Vec3::Zero();
}

}  // namespace

TailorLevels tailor_levels(const Figure& f) {
  return {f.p.chest_height, f.p.chest_height - kUnderbustDrop, f.p.waist_height,
          f.p.crotch_height + kSeatRise};
}

Vec3 on_ray(const Posed& b, std::initializer_list<Region> regions, const Vec3& origin,
            const Vec3& direction) {
  Hit farthest;
  Vec3 point = origin;
  for (const geometry::Triangle& t : b.triangles) {
    if (!all_in(b, t, regions)) continue;
    const Hit hit = meet(b.rest[t[0]], b.rest[t[1]], b.rest[t[2]], origin, direction);
    if (!(hit.distance > farthest.distance)) continue;
    farthest = hit;
    point = hit.weight[0] * b.posed[t[0]] + hit.weight[1] * b.posed[t[1]] + hit.weight[2] * b.posed[t[2]];
  }
  return point;
}

void walk_section(const Posed& b, const Vec3& origin, const Vec3& normal,
                  const std::function<void(const Vec3&, const Vec3&)>& visit) {
  const auto height = [&](Index v) { return (b.rest[v] - origin).dot(normal); };
  for (const geometry::Triangle& t : b.triangles) {
    if (!on_trunk_or_leg(b, t)) continue;
    std::array<Vec3, 2> ends;
    int found = 0;
    for (int k = 0; k < 3 && found < 2; ++k) {
      const double one = height(t[k]), other = height(t[(k + 1) % 3]);
      if ((one > 0.0) == (other > 0.0)) continue;
      const double share = one / (one - other);
      ends[found++] = (1.0 - share) * b.posed[t[k]] + share * b.posed[t[(k + 1) % 3]];
    }
    if (found == 2) visit(ends[0], ends[1]);
  }
}

void add_tailor_landmarks(const Posed& b, std::vector<body::Landmark>& landmarks) {
  const Figure& f = b.figure;
  const auto put = [&](LandmarkId id, const Vec3& p) {
    landmarks[static_cast<std::size_t>(id)] = {id, p, nearest_vertex(b.posed, p), 1.0};
  };
  const auto rest_joint = [&](Bone bone) { return f.joint[index(bone)]; };
  const auto joint = [&](Bone bone) { return Vec3(b.bones[index(bone)] * rest_joint(bone)); };
  const double depth = rest_joint(Bone::kNeck).z();
  const auto of_neck = [&](double height, const Vec3& direction) {
    return on_ray(b, {Region::kTrunk, Region::kHead}, Vec3(0.0, height, depth), direction);
  };
  put(LandmarkId::kNeckFront, of_neck(f.p.acromion_height, Vec3::UnitZ()));
  put(LandmarkId::kNeckBack, of_neck(f.p.neck_height, -Vec3::UnitZ()));
  const TailorLevels levels = tailor_levels(f);
  put(LandmarkId::kUnderbust, level_center(b, levels.underbust));
  put(LandmarkId::kWaist, level_center(b, levels.waist));
  put(LandmarkId::kHip, level_center(b, levels.hip));
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    put(body::of_side(LandmarkId::kNeckSideL, side),
        of_neck(f.p.neck_height - kNeckSideDrop, sign * Vec3::UnitX()));
    put(body::of_side(LandmarkId::kShoulderL, side),
        on_ray(b, {Region::kTrunk, region_of_side(Region::kArmL, side)},
               rest_joint(of_side(Bone::kUpperArmL, side)), Vec3(0.35 * sign, 1.0, 0.0).normalized()));
    put(body::of_side(LandmarkId::kBustL, side),
        on_ray(b, {Region::kTrunk}, Vec3(sign * kBustHalf, levels.bust, depth), Vec3::UnitZ()));
    put(body::of_side(LandmarkId::kWristL, side), joint(of_side(Bone::kHandL, side)));
    put(body::of_side(LandmarkId::kAnkleL, side), joint(of_side(Bone::kFootL, side)));
  }
}

}  // namespace bodice::synth
