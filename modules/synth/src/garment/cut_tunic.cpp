// The tunic: a tube to the armpits, and above it a front and a back panel joined over the shoulders.
//
//        strap  hole  strap          rows run from the tube's front edge over a shoulder
//       o--o            o--o         to the tube's back edge; the neck's columns stop at
//       |  |____________|  |         the neckline on both sides
//       o--o--o--o--o--o--o--o
//  ====== tube, closed at the sides ======
#include <algorithm>
#include <cmath>
#include <numbers>

#include "garment/tailor.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using body::Part;
using geometry::Index;

using std::numbers::pi;
constexpr double kPanelShare = 0.8;      // width of the panels, in distances of the armpits
constexpr double kFrontNeckline = 0.55;  // from the armpits' height (0) over the front to the shoulder (1)
constexpr double kBackNeckline = 0.7;
constexpr double kNeckFoot = 0.035;  // in statures from the lowest skin of the head upward
constexpr double kStrap = 0.02;      // width over a shoulder at the neck, in statures
// Where the neck leaves less room, straps are so wide all the same: a string would not carry a fine mesh.
constexpr double kLeastStrap = 0.009;

struct Plan {
  int front = 0;                      ///< cells across a panel
  int side = 0;                       ///< cells under an arm
  int rows = 0;                       ///< cells from the tube over the shoulder to the tube
  int hole_begin = 0, hole_end = 0;   ///< columns around the neck hole
  int hole_front = 0, hole_back = 0;  ///< rows around the neck hole
  double half_width = 0.0;
  double top = 0.0, hem = 0.0;

  int columns() const { return 2 * (front + side); }
  double x(int i) const { return half_width * (1.0 - 2.0 * i / front); }  ///< coordinate of panel column i
  bool in_hole(int i, int r) const {
    return i > hole_begin && i < hole_end && r > hole_front && r < hole_back;
  }
  bool cell_in_hole(int i, int r) const {
    return i >= hole_begin && i < hole_end && r >= hole_front && r < hole_back;
  }
  Index back_column(int i) const { return static_cast<Index>(2 * front + side - i); }
};

/// The angle in (from, to) at which the outline has the given x, which is monotone there.
double angle_at(const Outline& outline, double x, double from, double to) {
  const auto x_at = [&](double a) { return outline.center.x + outline.at(a) * std::cos(a); };
  const bool falling = x_at(from) > x_at(to);
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (from + to);
    ((x_at(middle) > x) == falling ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

std::vector<double> ring_angles(const Plan& plan, const Outline& top) {
  std::vector<double> angles;
  const double front_right = angle_at(top, -plan.half_width, 0.0, pi);
  const double back_right = angle_at(top, -plan.half_width, pi, 2.0 * pi);
  const double back_left = angle_at(top, plan.half_width, pi, 2.0 * pi);
  const double front_left = angle_at(top, plan.half_width, 0.0, pi);
  for (int i = 0; i < plan.front; ++i) angles.push_back(angle_at(top, plan.x(i), 0.0, pi));
  for (int k = 0; k < plan.side; ++k)
    angles.push_back(front_right + (back_right - front_right) * k / plan.side);
  for (int i = plan.front; i > 0; --i) angles.push_back(angle_at(top, plan.x(i), pi, 2.0 * pi));
  for (int k = 0; k < plan.side; ++k)
    angles.push_back(back_left + (front_left + 2.0 * pi - back_left) * k / plan.side);
  return angles;
}

/// The profile over the shoulder at column i: an outline in the (z, y) plane around the middle of the tube's
/// edge.
Outline profile(const Fitting& f, const Plan& plan, int i, const Vec3& front, const Vec3& back) {
  const double half = std::max(plan.half_width / plan.front, 0.5 * f.options.edge_length_m);
  const PartFilter not_head = [](Part part) { return part != Part::kHead; };
  std::vector<Point2> points;
  const Point2 center{0.5 * (front.z() + back.z()), plan.top};
  for (const Vec3& p : f.skin.slab(0, plan.x(i) - half, plan.x(i) + half, not_head))
    if (p.y() > plan.top - 0.05 * f.body.stature_m) points.push_back({p.z(), p.y()});
  for (const Vec3* end : {&front, &back}) points.push_back({end->z(), plan.top});
  points.push_back({center.x, plan.top - 0.05 * f.body.stature_m});
  Outline outline = outline_of(convex_hull(std::move(points)), center);
  for (double& r : outline.radius) r += 1.1 * f.options.ease_m;
  return outline;
}

/// Angles over the top of an outline, 0 and pi included, in pieces of equal length.
std::vector<double> arch_angles(const Outline& outline, int pieces) {
  Outline closed = outline;  // the lower half mirrors the upper, so that half the pieces lie above
  for (int d = 1; d < Outline::kDirections / 2; ++d)
    closed.radius[Outline::kDirections - d] = outline.radius[d];
  return even_angles(closed, 2 * pieces, 0.0);
}

/// Half the width of a neck hole that is clear of the neck. That is judged by the head's lowest skin, which
/// need not be at the height of the neck's joint.
double neck_width(const Fitting& f) {
  const double h = f.body.stature_m, joint = levels_of(f).neck;
  const PartFilter head = [](Part part) { return part == Part::kHead; };
  double foot = joint + 0.1 * h, neck = 0.0;
  for (const Vec3& p : f.skin.slab(1, joint - 0.1 * h, joint + 0.1 * h, head)) foot = std::min(foot, p.y());
  for (const Vec3& p : f.skin.slab(1, foot, foot + kNeckFoot * h, head))
    neck = std::max(neck, std::abs(p.x()));
  return neck + 1.5 * f.options.ease_m;
}

/// Whether cloth at +-x, and half a cell further inward, passes over the shoulders without climbing the neck.
bool beside_neck(const Fitting& f, double x) {
  const auto highest = [&](double from, double to, bool head) {
    double y = -1e9;
    for (const Vec3& p : f.skin.slab(0, from, to, [&](Part part) { return (part == Part::kHead) == head; }))
      y = std::max(y, p.y());
    return y;
  };
  const double in = x - 0.5 * f.options.edge_length_m - f.options.ease_m,
               out = x + 0.5 * f.options.edge_length_m;
  return highest(in, out, true) <= highest(in, out, false) &&
         highest(-out, -in, true) <= highest(-out, -in, false);
}

Plan make_plan(const Fitting& f) {
  const double h = f.body.stature_m, edge = f.options.edge_length_m;
  const Levels levels = levels_of(f);
  Plan plan;
  plan.top = tube_top(f);
  plan.hem = 0.02 * h;
  const double left = local_landmark(f.body, f.frame, body::LandmarkId::kArmpitL).x();
  const double right = -local_landmark(f.body, f.frame, body::LandmarkId::kArmpitR).x();
  plan.half_width = kPanelShare * std::min(left, right);
  plan.front = std::max(8, 2 * static_cast<int>(std::lround(plan.half_width / edge)));
  plan.side = std::max(2, static_cast<int>(std::lround(0.12 * h / edge)));
  const double over = 2.2 * (levels.neck - plan.top) + 0.06 * h;
  plan.rows = std::max(8, 2 * static_cast<int>(std::lround(0.5 * over / edge)));
  plan.hole_front = static_cast<int>(std::lround(0.5 * kFrontNeckline * plan.rows));
  plan.hole_back = plan.rows - static_cast<int>(std::lround(0.5 * kBackNeckline * plan.rows));
  const double cell = 2.0 * plan.half_width / plan.front;
  const int most = plan.front / 2 - 1;
  const int least = std::clamp(static_cast<int>(std::lround(kLeastStrap * h / cell)), 1, most);
  plan.hole_begin = std::clamp(static_cast<int>((plan.half_width - neck_width(f)) / cell), least, most);
  const int strap = std::clamp(static_cast<int>(std::lround(kStrap * h / cell)), plan.hole_begin, most);
  for (int i = plan.hole_begin + 1; i <= strap && beside_neck(f, plan.x(i)); ++i) plan.hole_begin = i;
  plan.hole_end = plan.front - plan.hole_begin;
  return plan;
}

/// Adds the panels' vertices and returns the number of each, by column and row.
std::vector<std::vector<Index>> add_panels(const Fitting& f, const Plan& plan, Cut& cut) {
  std::vector<std::vector<Index>> at(plan.front + 1, std::vector<Index>(plan.rows + 1, geometry::kNoIndex));
  for (int i = 0; i <= plan.front; ++i) {
    at[i][0] = static_cast<Index>(i);
    at[i][plan.rows] = plan.back_column(i);
    const Outline arch =
        profile(f, plan, i, cut.mesh.positions[at[i][0]], cut.mesh.positions[at[i][plan.rows]]);
    const std::vector<double> angles = arch_angles(arch, plan.rows);
    for (int r = 1; r < plan.rows; ++r) {
      if (plan.in_hole(i, r)) continue;
      const Vec3 out(0.0, std::sin(angles[r]), std::cos(angles[r]));
      at[i][r] = static_cast<Index>(cut.mesh.positions.size());
      cut.mesh.positions.push_back(Vec3(plan.x(i), arch.center.z, arch.center.x) + arch.at(angles[r]) * out);
      cut.outward.push_back(out);
    }
  }
  return at;
}

}  // namespace

engine::Result<Cut> cut_tunic(const Fitting& f) {
  const Plan plan = make_plan(f);
  const double edge = f.options.edge_length_m;
  const PartFilter lower = [](Part part) { return body::is_torso(part) || is_leg(part); };
  const int rings = std::max(4, static_cast<int>(std::lround((plan.top - plan.hem) / edge)) + 1);
  Cut cut;
  std::vector<double> angles;
  for (int r = 0; r < rings; ++r) {
    const double y = plan.top - (plan.top - plan.hem) * r / (rings - 1);
    const Outline outline = ring_outline(f, y - 0.5 * edge, y + 0.5 * edge, lower, slice_center(f, y, lower));
    if (*std::min_element(outline.radius.begin(), outline.radius.end()) <= 0.0)
      return engine::Error{engine::ErrorCode::kUnusableGeometry,
                           "The body's torso is not closed between hips and armpits.",
                           "Check that the body's torso is labeled."};
    if (r == 0) angles = ring_angles(plan, outline);
    add_ring(cut, outline, y, angles);
  }
  join_rings(cut, rings, plan.columns());
  const auto at = add_panels(f, plan, cut);
  for (int i = 0; i < plan.front; ++i)
    for (int r = 0; r < plan.rows; ++r)
      if (!plan.cell_in_hole(i, r))
        add_quad(cut, at[i + 1][r], at[i][r], at[i][r + 1], at[i + 1][r + 1], (i + r) % 2 == 1);
  return cut;
}

}  // namespace bodice::synth
