// Garments that go round: the skirt and the tube.
#include <algorithm>
#include <cmath>

#include "tailor.hpp"

namespace bodice::synth {
namespace {

using body::Part;

constexpr double kSkirtLength = 0.33;  // of stature: from the waist to the knees of one who stands
constexpr double kBandWidth = 0.012;   // of stature: the pinned waistband

engine::Error unusable(std::string message) {
  return {engine::ErrorCode::kUnusableGeometry, std::move(message),
          "Check that the body's torso and thighs are labelled."};
}

int columns_for(const Outline& outline, double edge) {
  return std::max(12, 2 * static_cast<int>(std::lround(perimeter(outline) / (2.0 * edge))));
}

}  // namespace

engine::Result<Cut> cut_skirt(const Fitting& f) {
  const Levels levels = levels_of(f);
  const PartFilter lower = [](Part part) { return body::is_torso(part) || is_leg(part); };
  if (f.skin.slab(1, -0.3 * f.body.stature_m, 0.0, is_leg).empty() &&
      f.skin.slab(1, 0.0, levels.waist, is_leg).empty())
    return unusable("The body has no thighs below its trunk to wear a skirt.");
  const double edge = f.options.edge_length_m, length = kSkirtLength * f.body.stature_m;
  const Point2 center = slice_center(f, levels.waist, [](Part part) { return body::is_torso(part); });
  const int rings = std::max(4, static_cast<int>(std::lround(length / edge)) + 1);
  // Each ring is at least as wide as the one above: cloth hangs from the widest place, and does not follow
  // the legs inward.
  std::vector<Outline> outlines;
  std::vector<double> heights;
  for (int r = 0; r < rings; ++r) {
    heights.push_back(levels.waist - length * r / (rings - 1));
    Outline outline = ring_outline(f, heights[r] - edge, heights[r] + edge, lower, center);
    if (r == 0 && *std::min_element(outline.radius.begin(), outline.radius.end()) <= 0.0)
      return unusable("The body has no closed waist to hang a skirt from.");
    for (int d = 0; r > 0 && d < Outline::kDirections; ++d)
      outline.radius[d] = std::max(outline.radius[d], outlines.back().radius[d]);
    outlines.push_back(outline);
  }
  Cut cut;
  const Outline& widest = outlines.back();
  const std::vector<double> angles = even_angles(widest, columns_for(widest, edge), 0.0);
  for (int r = 0; r < rings; ++r) add_ring(cut, outlines[r], heights[r], angles);
  join_rings(cut, rings, static_cast<int>(angles.size()));
  const int band = std::max(1, static_cast<int>(std::lround(kBandWidth * f.body.stature_m / edge)));
  for (std::size_t v = 0; v < angles.size() * static_cast<std::size_t>(band); ++v)
    cut.pinned.push_back(static_cast<geometry::Index>(v));
  return cut;
}

engine::Result<Cut> cut_tube(const Fitting& f) {
  const Levels levels = levels_of(f);
  const PartFilter torso = [](Part part) { return body::is_torso(part); };
  const double edge = f.options.edge_length_m, top = tube_top(f),
               bottom = levels.waist - 0.03 * f.body.stature_m;
  const int rings = std::max(4, static_cast<int>(std::lround((top - bottom) / edge)) + 1);
  Cut cut;
  std::vector<double> angles;
  for (int r = 0; r < rings; ++r) {
    const double y = top - (top - bottom) * r / (rings - 1);
    const Outline outline = ring_outline(f, y - 0.5 * edge, y + 0.5 * edge, torso, slice_center(f, y, torso));
    if (*std::min_element(outline.radius.begin(), outline.radius.end()) <= 0.0)
      return unusable("The body's torso is not closed between waist and armpits.");
    if (r == 0) angles = even_angles(outline, columns_for(outline, edge), 0.0);
    add_ring(cut, outline, y, angles);
  }
  join_rings(cut, rings, static_cast<int>(angles.size()));
  return cut;
}

}  // namespace bodice::synth
