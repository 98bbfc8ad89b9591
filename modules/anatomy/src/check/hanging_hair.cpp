#include "check/hanging_hair.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "skin/plane_crossings.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;
using Point = HeadProfile::Point;

/// Hollows of the nape below the line from the head to the back are .011 of the body size deep and more on
/// clean bodies with a wide neck, and at most .008 under hair that stands off by centimeters.
constexpr double kFlatNape = 0.0095;
/// The number of steps from the back of the head to the back in which the outermost point is kept.
constexpr std::size_t kNapeSteps = 24;
/// The back lies this far below the middle of the head, by the head's radius, give or take a share of that.
constexpr double kBackBelow = 2.8, kBackHeight = 0.1;

/// The least reach to the side behind the neck, over these levels between the neck and the middle of the
/// head: up to .59 of the head's radius on clean bodies with a flat nape, and .63 and more where hair covers
/// it.
constexpr double kBareNeck = 0.62;
constexpr std::array kLevels = {0.2, 0.35, 0.5};
/// The skin behind the neck lies between the first two distances from its axis, and at most the third to the
/// side; by the head's radius.
constexpr double kBehind = 0.4, kFarBehind = 2.2, kFarAside = 1.6;

/// The points at which the plane of symmetry cuts the skin.
std::vector<Point> points_on_plane(const Skin& skin, const HeadProfile& profile) {
  std::vector<Point> points;
  for_each_crossing(skin, {profile.middle(), profile.across()}, [&](geometry::Index, const Vec3& position) {
    points.push_back(profile.on_plane(position));
  });
  return points;
}

/// The rearmost of the points about so far below the middle of the head; empty if there is none.
std::optional<Point> upper_back(const std::vector<Point>& points, double below) {
  std::optional<Point> back;
  for (const Point& p : points)
    if (std::abs(p.y() + below) < kBackHeight * below && (!back || p.x() < back->x())) back = p;
  return back;
}

/// How deep the outermost points lie below the line from the back of the head to the back. Those deeper than
/// `deepest` are the throat's.
double depth_below_line(const std::vector<Point>& points, const Point& head, const Point& back,
                        double deepest) {
  const Point along = (back - head).normalized(), outward(along.y(), -along.x());
  const double length = (back - head).norm();
  std::array<double, kNapeSteps> outermost;
  outermost.fill(-deepest);
  for (const Point& p : points) {
    const double step = (p - head).dot(along) / length * static_cast<double>(kNapeSteps);
    if (!(step >= 0.0 && step < static_cast<double>(kNapeSteps))) continue;
    double& most = outermost[static_cast<std::size_t>(step)];
    most = std::max(most, outward.dot(p - head));
  }
  double depth = 0.0;
  for (const double most : outermost)
    if (most > -deepest) depth = std::max(depth, -most);
  return depth;
}

/// How deep the nape lies below the line from the head to the back, a fraction of the body size; empty where
/// either is not found.
std::optional<double> nape_hollow(const Skin& skin, const HeadProfile& profile, double size_m) {
  const double radius = profile.head().radius / size_m;
  const std::vector<Point> points = points_on_plane(skin, profile);
  const std::optional<Point> head = profile.back(), back = upper_back(points, kBackBelow * radius);
  if (!head || !back) return std::nullopt;
  return depth_below_line(points, *head, *back, radius);
}

/// How far what lies behind the neck reaches to the side at a level, by the head's radius.
double reach_behind(const Skin& skin, const HeadProfile& profile, const Vec3& level) {
  const Vec3 backward = profile.up().cross(profile.across());
  const double radius = profile.head().radius;
  double reach = 0.0;
  for_each_crossing(skin, {level, profile.up()}, [&](geometry::Index, const Vec3& position) {
    const double behind = (position - level).dot(backward) / radius,
                 aside = std::abs((position - level).dot(profile.across())) / radius;
    if (behind > kBehind && behind < kFarBehind && aside < kFarAside) reach = std::max(reach, aside);
  });
  return reach;
}

}  // namespace

bool covers_nape(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks) {
  const HeadProfile& profile = *marks.head_profile;
  const auto hollow = nape_hollow(skin, profile, double{coordinates.size_m()});
  if (!hollow || *hollow >= kFlatNape) return false;
  const Vec3& neck = marks[LandmarkId::kNeck].loop.center;
  return std::ranges::all_of(kLevels, [&](double share) {
    return reach_behind(skin, profile, neck + share * (profile.middle() - neck)) > kBareNeck;
  });
}

}  // namespace bodice::anatomy
