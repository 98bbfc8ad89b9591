// Garments that rest on the shoulders: the poncho and the tunic.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "garment/tailor.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using body::Part;
using geometry::Index;

constexpr double kPonchoReach = 0.3;  // statures from the middle of the neck to the hem
/// Skin that is farther from the neck's middle than kNeckRadius, and at most kShoulderHeight higher, is
/// shoulder, whatever its part; in statures.
constexpr double kNeckRadius = 0.05, kShoulderHeight = 0.03;

engine::Error arms_too_high(std::string message) {
  return {engine::ErrorCode::kUnusableGeometry, std::move(message),
          "Choose a pose with the arms below the shoulders, or another garment."};
}

}  // namespace

// Cuts a flat sheet over the shoulders, with a hole that the neck fits through.
engine::Result<Cut> cut_poncho(const Fitting& f) {
  const double h = f.body.stature_m, edge = f.options.edge_length_m, ease = f.options.ease_m,
               reach = kPonchoReach * h;
  const Vec3 neck = local_landmark(f.body, f.frame, body::LandmarkId::kNeck);
  const PartFilter head = [](Part part) { return part == Part::kHead; };
  const PartFilter others = [](Part part) { return part != Part::kHead; };
  const auto away = [&](const Vec3& p) { return std::hypot(p.x() - neck.x(), p.z() - neck.z()); };
  double highest = -1e9;
  for (const Vec3& p : f.skin.slab(1, neck.y() - h, neck.y() + h, others))
    if (away(p) < reach + 2.0 * edge) highest = std::max(highest, p.y());
  for (const Vec3& p : f.skin.slab(1, neck.y() - h, neck.y() + kShoulderHeight * h, head))
    if (away(p) > kNeckRadius * h && away(p) < reach + 2.0 * edge) highest = std::max(highest, p.y());
  const double y = highest + 1.1 * ease;
  if (!(y < neck.y() + 0.1 * h)) return arms_too_high("The arms are raised through where a poncho lies.");
  const Point2 center = slice_center(f, y, head);
  const Outline hole = ring_outline(f, y - 1.5 * ease, y + 1.5 * ease, head, center);
  if (*std::min_element(hole.radius.begin(), hole.radius.end()) <= 0.0)
    return arms_too_high("The body has no neck above its shoulders.");
  const double inner = perimeter(hole) / (2.0 * std::numbers::pi);
  const int rings = std::max(3, static_cast<int>(std::lround((reach - inner) / edge)) + 1);
  const int columns =
      std::max(12, 2 * static_cast<int>(std::lround(std::numbers::pi * std::sqrt(inner * reach) / edge)));
  const std::vector<double> angles = even_angles(hole, columns, 0.0);
  Cut cut;
  for (int r = 0; r < rings; ++r) {
    const double t = static_cast<double>(r) / (rings - 1);
    Outline ring = hole;
    for (double& radius : ring.radius) radius = (1.0 - t) * radius + t * reach;
    add_ring(cut, ring, y, angles);
  }
  join_rings(cut, rings, columns);
  return cut;
}

}  // namespace bodice::synth
