#include "skin/centerline.hpp"

#include <array>
#include <cmath>

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;

constexpr std::size_t kSlices = 24;
/// The number of slices before and behind a joint that show the axes of the limb there.
constexpr std::size_t kArm = 5;

/// The skin between two levels, by area.
struct Slice {
  Vec3 moment = Vec3::Zero();
  double area = 0.0;
  Vec3 middle() const { return moment / area; }
};

std::array<Slice, kSlices> slices(const Skin& skin, std::span<const float> from_end, float from, float step) {
  std::array<Slice, kSlices> result;
  for (std::size_t f = 0; f < skin.mesh.triangles.size(); ++f) {
    const auto& t = skin.mesh.triangles[f];
    const float level = (from_end[t[0]] + from_end[t[1]] + from_end[t[2]]) / 3.0F;
    const float at = (level - from) / step;
    if (!(at >= 0.0F && at < static_cast<float>(kSlices))) continue;
    const double area = geometry::area_vector(skin.mesh, f).norm();
    Slice& slice = result[static_cast<std::size_t>(at)];
    slice.moment +=
        area / 3.0 * (skin.mesh.positions[t[0]] + skin.mesh.positions[t[1]] + skin.mesh.positions[t[2]]);
    slice.area += area;
  }
  return result;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

Bend sharpest_bend(const Skin& skin, std::span<const float> from_end, float from, float to) {
  const float step = (to - from) / static_cast<float>(kSlices);
  if (!(step > 0.0F)) return {};
  const auto line = slices(skin, from_end, from, step);
  Bend best;
  for (std::size_t i = kArm; i + kArm < kSlices; ++i) {
    if (!(line[i - kArm].area > 0.0 && line[i].area > 0.0 && line[i + kArm].area > 0.0)) continue;
    const Vec3 here = line[i].middle();
    const auto angle =
        static_cast<float>(angle_between(here - line[i - kArm].middle(), line[i + kArm].middle() - here));
    if (angle > best.angle_rad) best = {from + (static_cast<float>(i) + 0.5F) * step, angle};
  }
  return best;
}

}  // namespace bodice::anatomy
