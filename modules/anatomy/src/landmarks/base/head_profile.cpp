#include "landmarks/base/head_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "skin/plane_crossings.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;
using Point = HeadProfile::Point;

/// The outline is read from the forehead to the back of the head, in radians from the crown; before it lies
/// the nose, and behind it the nape, which are hollow on all heads.
constexpr double kForehead = 0.6, kBack = -1.55;
/// The outline has one point in each step of a degree and a half: the outermost.
constexpr std::size_t kOutlinePoints = 86;

/// A point belongs to the side of a hollow's deepest point on which it lies by more than this, a fraction of
/// the squared body size: a degree.
constexpr double kBesideHollow = 1e-4;

double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The outermost point in each step of the outline's turn, or zero.
class Outermost {
 public:
  Outermost() { points_.fill(Point::Zero()); }

  void add(const Point& p) {
    const double turn = (std::atan2(p.x(), p.y()) - kBack) / (kForehead - kBack);
    if (!(turn >= 0.0 && turn < 1.0)) return;
    Point& far = points_[static_cast<std::size_t>(turn * static_cast<double>(kOutlinePoints))];
    if (p.squaredNorm() > far.squaredNorm()) far = p;
  }

  std::vector<Point> farther_than(double radius) const {
    std::vector<Point> points;
    std::ranges::copy_if(points_, std::back_inserter(points),
                         [radius](const Point& p) { return p.norm() > radius; });
    return points;
  }

 private:
  std::array<Point, kOutlinePoints> points_;
};

/// The corners of a band that is stretched over the points.
std::vector<Point> stretched(const std::vector<Point>& points) {
  std::vector<Point> band;
  for (const Point& p : points) {
    while (band.size() > 1 &&
           cross(band.back() - band[band.size() - 2], p - band.back()) >= 0.0)  // a turn to the left
      band.pop_back();
    band.push_back(p);
  }
  return band;
}

struct Hollow {
  std::size_t deepest = 0;  // index of a point
  double depth = 0.0;
};

/// The hollows below a band that is stretched over the points, from the back to the forehead.
std::vector<Hollow> hollows(const std::vector<Point>& points) {
  const std::vector<Point> band = stretched(points);
  if (band.size() < 2) return {};
  std::vector<Hollow> found(band.size() - 1);
  std::size_t edge = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    while (edge + 2 < band.size() && cross(points[k], band[edge + 1]) >= 0.0) ++edge;
    const Point along = (band[edge + 1] - band[edge]).normalized();
    const double depth = -cross(along, points[k] - band[edge]);
    if (depth > found[edge].depth) found[edge] = {k, depth};
  }
  return found;
}

}  // namespace

HeadProfile::HeadProfile(const Skin& skin, const BodyCoordinates& coordinates, const Ball& head,
                         const Loop& neck)
    : head_(head), size_m_(coordinates.size_m()) {
  const Midline& midline = coordinates.midline();
  up_ = (middle() - neck.center).normalized();
  across_ = up_.cross(midline.front.position - midline.back.position).normalized();
  Outermost outermost;
  for_each_crossing(skin, {middle(), across_}, [&](geometry::Index v, const Vec3& p) {
    if (coordinates.on_head(v)) outermost.add(on_plane(p));
  });
  outline_ = outermost.farther_than(kOuterHead * head.radius / size_m_);
  for (const Hollow& hollow : hollows(outline_)) {
    hollow_ = std::max(hollow_, hollow.depth);
    if (hollow.depth > kMaxHollow) deep_hollows_.push_back(hollow.deepest);
  }
}

Point HeadProfile::on_plane(const Vec3& position) const {
  const Vec3 from_middle = position - middle();
  return Point(from_middle.dot(across_.cross(up_)), from_middle.dot(up_)) / size_m_;
}

bool HeadProfile::is_on_hair(const Vec3& position) const {
  if (deep_hollows_.empty()) return false;
  const Point p = on_plane(position);
  const double before_first = cross(p, outline_[deep_hollows_.back()]),
               before_last = cross(p, outline_[deep_hollows_.front()]);
  return before_first < -kBesideHollow && (deep_hollows_.size() == 1 || before_last > kBesideHollow);
}

std::vector<Vec3> HeadProfile::before_hair() const {
  if (deep_hollows_.empty()) return {};
  const Vec3 forward = across_.cross(up_);
  std::vector<Vec3> positions;
  for (std::size_t k = deep_hollows_.back(); k < outline_.size(); ++k)
    positions.emplace_back(middle() + size_m_ * (outline_[k].x() * forward + outline_[k].y() * up_));
  return positions;
}

std::optional<HeadProfile> head_profile(const Skin& skin, const BodyCoordinates& coordinates,
                                        const Ball& head, const Loop& neck) {
  if (!neck.found() || !(head.radius > 0.0)) return std::nullopt;
  return HeadProfile(skin, coordinates, head, neck);
}

}  // namespace bodice::anatomy
