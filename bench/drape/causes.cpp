#include "causes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include <bodice/binding/poser.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/tryon/judge_frame.hpp>
#include <bodice/tryon/skin_room.hpp>

#include <bench_support/or_exit.hpp>
#include "conditions.hpp"

namespace bench {
namespace {

using namespace bodice;
using body::Part;
using geometry::Vec3;

constexpr std::size_t kListed = 5;  // pairs of parts in a line

/// The part of the skin nearest to a point.
Part part_at(const tryon::SegmentedSkin& skin, const geometry::MeshDistance& distance, const Vec3& at) {
  const geometry::Index triangle = distance.closest_point(at).triangle;
  return skin.anatomy.part[skin.input.skin.triangles[triangle][0]];
}

template <class Enum>
std::size_t index(Enum value) {
  return static_cast<std::size_t>(value);
}

double depth_in(const collision::Collider& collider, const Vec3& world) {
  const Eigen::Vector3f p = (world - collider.origin()).cast<float>();
  return -double{collider.query({p.x(), p.y(), p.z()}).signed_distance};
}

/// The proxy in the pose of a kept frame, as the cloth met it.
collision::Collider collider_in(const engine::Context& context, const Judged& j, std::size_t frame) {
  tryon::MotionPlayer player(j.motion, j.draped.report.ramp_s);
  std::vector<rig::Affine> joints(j.motion.rig.skeleton.joints.size());
  player.joints(j.draped.report.kept[frame].time_s, joints);
  binding::Poser poser = or_exit(binding::Poser::make(j.body.fit.proxy));
  for (const auto& base : j.draped.bases) or_exit(poser.keep_base(base));
  or_exit(poser.pose(context, joints));
  collision::Collider collider(j.body.fit.proxy);
  collider.pose(poser.posed(), 0.0);
  collider.cover(context, j.draped.body_frames[frame]);
  return collider;
}

}  // namespace

void add_deep_particles(const engine::Context& context, const Judged& j, std::size_t frame,
                        DeepParticles& found) {
  const tryon::SegmentedSkin& skin = j.body.skin;
  const geometry::TriMesh now{j.draped.body_frames[frame], skin.input.skin.triangles};
  const geometry::MeshDistance posed(context, now);
  const collision::Collider collider = collider_in(context, j, frame);
  const std::vector<Vec3>& at = j.draped.garments.front().frames[frame];
  const tryon::SkinRoom room(now, posed);
  const double least_m = 2.0 * j.draped.report.thickness_m;
  for (std::size_t v = 0; v < at.size(); ++v) {
    const geometry::SurfacePoint nearest = posed.closest_point(at[v]);
    if (!(nearest.signed_distance < -DeepParticles::kDeep_m)) continue;
    const DeepCause cause = tryon::is_overlapped(posed, at[v], nearest)                  ? DeepCause::kOverlap
                            : room.width_m(at[v], least_m) < least_m                     ? DeepCause::kNoRoom
                            : depth_in(collider, at[v]) < 0.5 * -nearest.signed_distance ? DeepCause::kProxy
                                                                                         : DeepCause::kCloth;
    DeepParticles::Of& of = found.of[index(cause)];
    ++of.count;
    if (-nearest.signed_distance <= of.deepest_m) continue;
    of.deepest_m = -nearest.signed_distance;
    of.time_s = j.draped.report.kept[frame].time_s;
    of.own = part_at(skin, *skin.distance, j.garment.positions[v]);
    of.in = skin.anatomy.part[skin.input.skin.triangles[nearest.triangle][0]];
  }
}

void print_deep_particles(const DeepParticles& found) {
  constexpr const char* kNames[kDeepCauses] = {"in skin that overlaps itself", "where skin leaves no room",
                                               "outside of the proxy", "inside of the proxy"};
  for (std::size_t c = 0; c < kDeepCauses; ++c) {
    const DeepParticles::Of& of = found.of[c];
    if (of.count == 0) continue;
    std::printf("    %-28s %5zu particles over 2 mm, deepest %5.2f mm at %.2f s: of %s, in %s\n", kNames[c],
                of.count, 1e3 * of.deepest_m, of.time_s, std::string(body::kPartNames[index(of.own)]).c_str(),
                std::string(body::kPartNames[index(of.in)]).c_str());
  }
}

Causes find_causes(const engine::Context& context, const Judged& j, std::size_t frame) {
  const tryon::SegmentedSkin& skin = j.body.skin;
  const geometry::MeshDistance posed(context, {j.draped.body_frames[frame], skin.input.skin.triangles});
  const collision::Collider collider = collider_in(context, j, frame);
  const std::vector<Vec3>& at = j.draped.garments.front().frames[frame];
  geometry::DistanceWalk walk(posed);
  Causes causes;
  for (const geometry::Triangle& t : j.garment.triangles) {
    std::optional<Part> own;
    bool corner_in = false;
    tryon::for_each_inside(posed, walk, at, t, kVisible_m, [&](const tryon::InsidePoint& point) {
      if (!own) {
        own = part_at(skin, *skin.distance, j.garment.positions[t[0]]);
        corner_in = std::ranges::any_of(t, [&](auto v) { return depth_in(collider, at[v]) > kVisible_m; });
      }
      const Cause cause = point.is_overlapped                               ? Cause::kOverlap
                          : depth_in(collider, point.at) < 0.5 * kVisible_m ? Cause::kProxy
                          : corner_in                                       ? Cause::kParticle
                                                                            : Cause::kFace;
      causes.cm2[index(cause)][index(*own)][index(part_at(skin, posed, point.at))] += 1e4 * point.area_m2;
    });
  }
  return causes;
}

double Causes::of(Cause cause) const {
  double sum = 0.0;
  for (const ByPart& row : cm2[index(cause)])
    for (const double area : row) sum += area;
  return sum;
}

void Causes::add(const Causes& other, double share) {
  for (std::size_t c = 0; c < kCauses; ++c)
    for (std::size_t own = 0; own < cm2[c].size(); ++own)
      for (std::size_t in = 0; in < cm2[c][own].size(); ++in)
        cm2[c][own][in] += share * other.cm2[c][own][in];
}

void print_causes(const Causes& causes, const std::string& when) {
  constexpr const char* kNames[kCauses] = {"overlap", "proxy too deep", "particle", "face"};
  for (std::size_t c = 0; c < kCauses; ++c) {
    std::vector<std::pair<double, std::string>> pairs;
    for (std::size_t own = 0; own < body::kPartCount; ++own)
      for (std::size_t in = 0; in < body::kPartCount; ++in)
        pairs.push_back({causes.cm2[c][own][in],
                         std::string(body::kPartNames[own]) + " in " + std::string(body::kPartNames[in])});
    std::ranges::sort(pairs, std::greater<>());
    std::printf("  %s, cm2: %-14s %6.1f", when.c_str(), kNames[c], causes.of(static_cast<Cause>(c)));
    for (std::size_t k = 0; k < kListed && pairs[k].first > 0.05; ++k)
      std::printf("%s %s %.1f", k == 0 ? " |" : ",", pairs[k].second.c_str(), pairs[k].first);
    std::printf("\n");
  }
}

}  // namespace bench
