#include <bodice/tryon/skin_room.hpp>

#include <algorithm>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/crossings.hpp>
#include <bodice/geometry/triangle.hpp>
#include <bodice/tryon/judge_frame.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Triangle;
using geometry::Vec3;

// Two walls face each other where the cosine of the angle between their normals is below this.
constexpr double kFacingCosine = -0.5;
constexpr std::size_t kRoomGrain = 4;

/// Adds up the points where edges of `of` pass through `through`, and counts them.
void add_passages(std::span<const Vec3> at, const Triangle& of, const Triangle& through, Vec3& sum,
                  int& count) {
  const Vec3 &a = at[through[0]], &b = at[through[1]], &c = at[through[2]];
  const Vec3 normal = (b - a).cross(c - a);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &from = at[of[k]], &to = at[of[(k + 1) % 3]], along = to - from;
    const double first = normal.dot(from - a), second = normal.dot(to - a);
    if (!(first * second < 0.0)) continue;
    const double u = along.dot((b - from).cross(c - from)), v = along.dot((c - from).cross(a - from)),
                 w = along.dot((a - from).cross(b - from));
    if (!((u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0))) continue;
    sum += from + first / (first - second) * along;
    ++count;
  }
}

/// The mean of the points where edges of two triangles pass through the other one.
Vec3 mean_passage(std::span<const Vec3> at, const Triangle& s, const Triangle& t) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  add_passages(at, s, t, sum, count);
  add_passages(at, t, s, sum, count);
  return sum / std::max(count, 1);
}

}  // namespace

double SkinRoom::width_m(const Vec3& at, double most_m) const {
  const geometry::SurfacePoint below = distance_->closest_point(at);
  if (is_overlapped(*distance_, at, below)) return 0.0;
  const std::vector<Vec3>& p = skin_->positions;
  double least_m = most_m;
  for (const auto& [i, j, k] : skin_->triangles) {
    const Vec3 low = p[i].cwiseMin(p[j]).cwiseMin(p[k]), high = p[i].cwiseMax(p[j]).cwiseMax(p[k]);
    if (((low - below.point).array() > least_m).any() || ((below.point - high).array() > least_m).any())
      continue;
    const Vec3 normal = (p[j] - p[i]).cross(p[k] - p[i]);
    if (!(normal.dot(below.normal) < kFacingCosine * normal.norm())) continue;
    const Vec3 to_wall = geometry::closest_point(p[i], p[j], p[k], below.point).point - below.point;
    if (to_wall.dot(below.normal) > 0.0) least_m = std::min(least_m, to_wall.norm());
  }
  return least_m;
}

std::vector<JudgedCrossing> judge_crossings(const engine::Context& context, const SkinRoom& room,
                                            std::span<const Vec3> positions,
                                            std::span<const Triangle> triangles, double needed_m) {
  std::vector<JudgedCrossing> judged;
  for (const auto& pair : geometry::find_crossings(positions, triangles))
    judged.push_back({pair, mean_passage(positions, triangles[pair[0]], triangles[pair[1]]), false});
  engine::parallel_for(context, judged.size(), kRoomGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      judged[k].has_room = !(room.width_m(judged[k].at, needed_m) < needed_m);
  });
  return judged;
}

}  // namespace bodice::tryon
