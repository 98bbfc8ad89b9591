// Garments that surround the trunk: the skirt and the tube.
#include <algorithm>
#include <cmath>

#include "garment/tailor.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using body::Part;

// Lengths in statures.
constexpr double kSkirtLength = 0.33;  // from the waist to the knees of a standing body
constexpr double kBandWidth = 0.012;   // width of the pinned waistband

engine::Error no_torso(std::string message) {
  return {engine::ErrorCode::kUnusableGeometry, std::move(message),
          "Check that the body's torso and thighs are labeled."};
}

int columns_for(const Outline& outline, double edge) {
  return std::max(12, 2 * static_cast<int>(std::lround(perimeter(outline) / (2.0 * edge))));
}

/// Outlines from the waist down around one center, each at least as wide as the one above. Cloth hangs from
/// the widest point and does not follow the legs inward.
struct Funnel {
  std::vector<Outline> outlines;
  std::vector<double> heights;

  /// The length along the funnel from its top to each outline, at one angle.
  std::vector<double> lengths(double angle) const {
    std::vector<double> length{0.0};
    for (std::size_t i = 1; i < outlines.size(); ++i)
      length.push_back(length.back() + std::hypot(outlines[i].at(angle) - outlines[i - 1].at(angle),
                                                  heights[i] - heights[i - 1]));
    return length;
  }
};

Funnel funnel_of(const Fitting& f, double top, double length, const PartFilter& wanted,
                 const Point2& center) {
  const double edge = f.options.edge_length_m;
  const int slices = std::max(4, static_cast<int>(std::lround(length / edge)) + 1);
  Funnel funnel;
  for (int i = 0; i < slices; ++i) {
    funnel.heights.push_back(top - length * i / (slices - 1));
    const double y = funnel.heights.back();
    Outline outline = ring_outline(f, y - edge, y + edge, wanted, center);
    for (int d = 0; i > 0 && d < Outline::kDirections; ++d)
      outline.radius[d] = std::max(outline.radius[d], funnel.outlines.back().radius[d]);
    funnel.outlines.push_back(outline);
  }
  return funnel;
}

/// Adds rings at equal shares of each column's length. Over bent hips a column across the lap is many times
/// as long as one down the back, so that rings of equal height would leave the lap a single row.
void add_funnel(Cut& cut, const Funnel& funnel, int rings, std::span<const double> angles) {
  const std::size_t columns = angles.size(), first = cut.mesh.positions.size();
  cut.mesh.positions.resize(first + static_cast<std::size_t>(rings) * columns);
  cut.outward.resize(cut.mesh.positions.size());
  for (std::size_t c = 0; c < columns; ++c) {
    const Vec3 out(std::cos(angles[c]), 0.0, std::sin(angles[c]));
    const std::vector<double> length = funnel.lengths(angles[c]);
    std::size_t i = 0;
    for (int r = 0; r < rings; ++r) {
      const double wanted = length.back() * r / (rings - 1);
      while (i + 2 < length.size() && length[i + 1] < wanted) ++i;
      const double t = std::clamp((wanted - length[i]) / (length[i + 1] - length[i]), 0.0, 1.0);
      const Outline &above = funnel.outlines[i], &below = funnel.outlines[i + 1];
      const double radius = (1.0 - t) * above.at(angles[c]) + t * below.at(angles[c]),
                   y = (1.0 - t) * funnel.heights[i] + t * funnel.heights[i + 1];
      const std::size_t v = first + static_cast<std::size_t>(r) * columns + c;
      cut.mesh.positions[v] = Vec3(above.center.x, y, above.center.z) + radius * out;
      cut.outward[v] = out;
    }
  }
}

}  // namespace

engine::Result<Cut> cut_skirt(const Fitting& f) {
  const Levels levels = levels_of(f);
  const PartFilter lower = [](Part part) { return body::is_torso(part) || is_leg(part); };
  if (f.skin.slab(1, -0.3 * f.body.stature_m, 0.0, is_leg).empty() &&
      f.skin.slab(1, 0.0, levels.waist, is_leg).empty())
    return no_torso("The body has no thighs below its trunk to wear a skirt.");
  const double edge = f.options.edge_length_m, length = kSkirtLength * f.body.stature_m;
  const Point2 center = slice_center(f, levels.waist, [](Part part) { return body::is_torso(part); });
  const Funnel funnel = funnel_of(f, levels.waist, length, lower, center);
  const Outline& waist = funnel.outlines.front();
  if (*std::min_element(waist.radius.begin(), waist.radius.end()) <= 0.0)
    return no_torso("The body has no closed waist to hang a skirt from.");
  const Outline& widest = funnel.outlines.back();
  const std::vector<double> angles = even_angles(widest, columns_for(widest, edge), 0.0);
  double mean = 0.0;
  for (const double angle : angles) mean += funnel.lengths(angle).back() / static_cast<double>(angles.size());
  const int rings = std::max(4, static_cast<int>(std::lround(mean / edge)) + 1);
  Cut cut;
  add_funnel(cut, funnel, rings, angles);
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
      return no_torso("The body's torso is not closed between waist and armpits.");
    if (r == 0) angles = even_angles(outline, columns_for(outline, edge), 0.0);
    add_ring(cut, outline, y, angles);
  }
  join_rings(cut, rings, static_cast<int>(angles.size()));
  return cut;
}

}  // namespace bodice::synth
