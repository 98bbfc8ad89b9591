#include "garment/tailor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bodice::inline v0_1::synth {

using geometry::Index;

namespace {

constexpr double kTrunkShare = 0.85;  // share of the trunk in a slice's length above which it has no arms
constexpr double kArmpitFold = 0.02;  // statures from the armpit to where arms and trunk have separated
constexpr int kTopSteps = 50;  // steps of .002 stature: the lower half of the chest is not an armpit's height

/// Whether a ring of cloth around the trunk at height y has skin on its inner side only.
bool has_room(const Fitting& f, double y) {
  std::vector<Point2> points;
  const PartFilter torso = [](body::Part part) { return body::is_torso(part); };
  geometry::Box box;
  for (const Vec3& p : f.skin.slice(y, torso, kTrunkShare)) {
    points.push_back({p.x(), p.z()});
    box.extend(p);
  }
  if (box.empty()) return false;
  const Outline outline = outline_of(convex_hull(std::move(points)), {box.center().x(), box.center().z()});
  const auto distance = [&](double angle, double ease) {
    const double r = outline.at(angle) + ease;
    return f.signed_distance(
        {outline.center.x + r * std::cos(angle), y, outline.center.z + r * std::sin(angle)});
  };
  const double ease = f.options.ease_m;
  for (int d = 0; d < Outline::kDirections; d += 4) {
    const double angle = 2.0 * std::numbers::pi * d / Outline::kDirections;
    if (outline.at(angle) <= 0.0) return false;
    // On skin as steep as sixty degrees, half of an ease that is added horizontally remains.
    if (distance(angle, 1.05 * ease) < 0.4 * ease || distance(angle, 2.1 * ease) < 0.4 * ease) return false;
  }
  return true;
}

}  // namespace

bool is_leg(body::Part part) {
  return part >= body::Part::kThighL;
}

Levels levels_of(const Fitting& f) {
  const auto y = [&](body::LandmarkId id) { return local_landmark(f.body, f.frame, id).y(); };
  Levels levels;
  levels.neck = y(body::LandmarkId::kNeck);
  levels.armpit = 0.5 * (y(body::LandmarkId::kArmpitL) + y(body::LandmarkId::kArmpitR));
  levels.waist = 0.36 * levels.neck;  // from the perineum (0) to the neck (1), as in the surveys
  return levels;
}

double tube_top(const Fitting& f) {
  const auto y = [&](body::LandmarkId id) { return local_landmark(f.body, f.frame, id).y(); };
  const double armpit = std::min(y(body::LandmarkId::kArmpitL), y(body::LandmarkId::kArmpitR)),
               step = 0.002 * f.body.stature_m;
  const double above = 0.5 * f.options.edge_length_m;  // a ring is as wide as the skin this far above it
  for (int k = 0; k < kTopSteps; ++k)
    if (has_room(f, armpit - k * step)) return armpit - k * step - above;
  // The arms lie against the trunk over their whole length. The cut stays as it is, since pushing it from the
  // skin may still succeed.
  return armpit - kArmpitFold * f.body.stature_m;
}

Point2 slice_center(const Fitting& f, double y, const PartFilter& wanted) {
  geometry::Box box;
  for (const Vec3& p : f.skin.slice(y, wanted)) box.extend(p);
  return box.empty() ? Point2{} : Point2{box.center().x(), box.center().z()};
}

Outline ring_outline(const Fitting& f, double low, double high, const PartFilter& wanted,
                     const Point2& center) {
  std::vector<Point2> points;
  for (const double y : {low, 0.5 * (low + high), high})
    for (const Vec3& p : f.skin.slice(y, wanted)) points.push_back({p.x(), p.z()});
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
