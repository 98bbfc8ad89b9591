#include "tailor.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::synth {

using geometry::Index;

bool is_leg(body::Part part) {
  return part >= body::Part::kThighL;
}

Levels levels_of(const Fitting& f) {
  const auto y = [&](body::LandmarkId id) { return local_landmark(f.body, f.frame, id).y(); };
  Levels levels;
  levels.neck = y(body::LandmarkId::kNeck);
  levels.armpit = 0.5 * (y(body::LandmarkId::kArmpitL) + y(body::LandmarkId::kArmpitR));
  levels.waist = 0.36 * levels.neck;  // of the way from the perineum to the neck, as in the surveys
  return levels;
}

double tube_top(const Fitting& f) {
  const auto y = [&](body::LandmarkId id) { return local_landmark(f.body, f.frame, id).y(); };
  // Arms at 45 degrees part from the trunk by twice the ease at 2.8 times the ease.
  return std::min(y(body::LandmarkId::kArmpitL), y(body::LandmarkId::kArmpitR)) - 0.006 * f.body.stature_m -
         2.8 * f.options.ease_m;
}

Point2 slice_center(const Fitting& f, double y, const PartFilter& wanted) {
  const double half = 0.5 * f.options.edge_length_m;
  geometry::Box box;
  for (const Vec3& p : f.skin.slab(1, y - half, y + half, wanted)) box.extend(p);
  return box.empty() ? Point2{} : Point2{box.center().x(), box.center().z()};
}

Outline ring_outline(const Fitting& f, double low, double high, const PartFilter& wanted,
                     const Point2& center) {
  std::vector<Point2> points;
  for (const Vec3& p : f.skin.slab(1, low, high, wanted)) points.push_back({p.x(), p.z()});
  const auto hull = convex_hull(std::move(points));
  Outline outline = outline_of(hull, center);
  for (double& r : outline.radius)
    if (r > 0.0) r += 1.05 * f.options.ease_m;
  return outline;
}

void add_ring(Cut& cut, const Outline& outline, double y, std::span<const double> angles) {
  for (const double angle : angles) {
    const Vec3 out(std::cos(angle), 0.0, std::sin(angle));
    cut.mesh.positions.push_back(Vec3(outline.center.x, y, outline.center.z) + outline.at(angle) * out);
    cut.outward.push_back(out);
  }
}

void add_quad(Cut& cut, Index a, Index b, Index c, Index d, bool odd) {
  auto& triangles = cut.mesh.triangles;
  if (odd) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  } else {
    triangles.push_back({a, b, d});
    triangles.push_back({b, c, d});
  }
}

void join_rings(Cut& cut, int rings, int columns, Index first) {
  const auto at = [&](int r, int c) { return first + static_cast<Index>(r * columns + c % columns); };
  for (int r = 0; r + 1 < rings; ++r)
    for (int c = 0; c < columns; ++c)
      add_quad(cut, at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c), (r + c) % 2 == 1);
}

}  // namespace bodice::synth
