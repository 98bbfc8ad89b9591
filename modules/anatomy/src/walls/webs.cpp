#include "walls/webs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <bodice/geometry/fins.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_edges.hpp>

#include "check/thighs.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using geometry::MeshDistance;
using geometry::TriMesh;
using geometry::Vec3;

/// Number of triangles of the thinned skin on which depths are measured: on a person these are 4 mm apart,
/// which is near enough.
constexpr std::size_t kEnough = 50000;
// All lengths are fractions of the stature.
constexpr double kAround = 0.35;    ///< skin farther than this from the landmark is not looked at
constexpr double kDeepest = 0.15;   ///< no point of a body lies deeper
constexpr double kStep = 0.004;     ///< from one level to the next
constexpr double kFarthest = 0.25;  ///< the last level
constexpr double kMiddle = 0.01;    ///< the plane between the limbs is found within this distance
constexpr double kAhead = 0.084, kAheadStep = 0.006;  ///< where the thickest point of a level is looked for
constexpr double kShallow = 0.015;                    ///< what lies less deep shows no fold
constexpr std::array kLimbs{0.03, 0.045};             ///< from the plane to the middles of the limbs
/// The plane is above the fold where it has at least this share of the room beside it.
constexpr double kAsDeep = 0.9, kQuiteAsDeep = 0.95;
/// Between thighs that have not grown together, both shares are reached this far above the crotch, in the
/// mean, and higher in trunks that are deeper than most by this share of what they are deeper.
constexpr double kOpenCrotch = 0.059, kDeepTrunk = 0.058, kPerDepth = 0.6;
/// A web holds room itself, so that its fold lies this much higher than it would without.
constexpr double kOwnRoom = 0.0075;
/// The plane between the thighs is looked for so far to both sides, at levels with a share of their room
/// that grows with the distance.
constexpr double kAside = 0.04, kAsideStep = 0.005, kOffMiddle = 0.3;
constexpr std::array kNearLevels{0.012, 0.02, 0.028};
/// On a thin copy the crotch lies up to so much too high, or too low where a web is left.
constexpr double kTooHigh = 0.06, kTooLow = 0.12;
/// Skin within so much more than the nearest is made up if this share of its vertices is.
constexpr double kMadeUpAround = 0.03, kMadeUpShare = 0.03;
/// The least height of a web: whole bodies show less, with straight thighs and with bent ones. Of 87 that
/// stand all show less than .0155 at the crotch. Where holes were closed, webs are the rule.
struct Least {
  double crotch, armpit;
};
constexpr std::array kFoldLandmarks{LandmarkId::kArmpitL, LandmarkId::kArmpitR, LandmarkId::kPerineum};
constexpr Least kStanding{0.0175, 0.013}, kBent{0.035, 0.025}, kMadeUp{0.008, 0.006};

/// The route from a landmark into the body, between the two limbs that meet there.
struct Route {
  Vec3 from, inward, across, forward;
};

Vec3 at(const Anatomy& found, LandmarkId id) {
  return found.landmarks[static_cast<std::size_t>(id)].position;
}

/// The lower end of a limb; for both legs the middle between the knees.
Vec3 limb_end(const Anatomy& found, LandmarkId id) {
  if (id == LandmarkId::kPerineum)
    return 0.5 * (at(found, LandmarkId::kKneeL) + at(found, LandmarkId::kKneeR));
  return at(found, id == LandmarkId::kArmpitL ? LandmarkId::kElbowL : LandmarkId::kElbowR);
}

/// Inward halves the angle between the trunk and the limb, so that it points away from both in any pose.
Route route_inward(const Anatomy& found, LandmarkId id) {
  Route route;
  route.from = at(found, id);
  route.inward = (found.up + (route.from - limb_end(found, id)).normalized()).normalized();
  const Vec3 left = at(found, LandmarkId::kArmpitL) - at(found, LandmarkId::kArmpitR);
  route.across = left.cross(found.up).cross(route.inward).normalized();
  route.forward = route.inward.cross(route.across);
  return route;
}

/// Fins hang in the air, and bridge what is apart.
void drop_fins(TriMesh& mesh) {
  const geometry::MeshEdges edges = geometry::mesh_edges(mesh);
  if (edges.non_manifold == 0) return;
  const std::vector<bool> fin = geometry::find_fins(mesh, edges);
  std::size_t next = 0;
  std::erase_if(mesh.triangles, [&](const geometry::Triangle&) { return fin[next++]; });
}

/// The skin around a point. Of a fine mesh it has some of the triangles, each with its own corners: depths of
/// many millimeters do not need them all.
TriMesh crop(const TriMesh& skin, const Vec3& around, double radius) {
  std::vector<geometry::Triangle> near;
  for (const geometry::Triangle& t : skin.triangles)
    if ((skin.positions[t[0]] - around).squaredNorm() < radius * radius) near.push_back(t);
  const std::size_t step = 1 + near.size() / kEnough;
  if (step == 1) {
    TriMesh all{skin.positions, std::move(near)};
    drop_fins(all);
    return all;
  }
  TriMesh some;
  for (std::size_t i = 0; i < near.size(); i += step) {
    const auto first = static_cast<geometry::Index>(some.positions.size());
    for (const geometry::Index v : near[i]) some.positions.push_back(skin.positions[v]);
    some.triangles.push_back({first, first + 1, first + 2});
  }
  return some;
}

/// The room inside the body along a route.
class Room {
 public:
  Room(const MeshDistance& skin, const Route& route, double stature_m)
      : skin_(skin), route_(route), stature_m_(stature_m) {}

  /// The depth of the deepest point of a line from back to front, negative outside of the body.
  double on_line(double inward, double across) const {
    double most = -1.0;
    for (double ahead = -kAhead; ahead < kAhead + 0.5 * kAheadStep; ahead += kAheadStep)
      most =
          std::max(most, depth(route_.from + stature_m_ * (inward * route_.inward + across * route_.across +
                                                           ahead * route_.forward)));
    return most;
  }
  double between(double inward) const {
    return std::min({on_line(inward, -kMiddle), on_line(inward, 0.0), on_line(inward, kMiddle)});
  }
  /// The depth within the thinner of the two limbs.
  double beside(double inward) const {
    std::array<double, 2> side{};
    for (const double across : kLimbs) {
      side[0] = std::max(side[0], on_line(inward, -across));
      side[1] = std::max(side[1], on_line(inward, across));
    }
    return std::min(side[0], side[1]);
  }

 private:
  /// The depth of a point below the skin. Its sign is that of the nearest triangle's side, because the skin
  /// was cut out and encloses nothing.
  double depth(const Vec3& p) const {
    const auto hit = skin_.closest_point_within(p, kDeepest * stature_m_);
    if (!hit) return kDeepest;
    const double far = hit->signed_distance / stature_m_;
    return (p - hit->point).dot(hit->normal) < 0.0 ? far : -far;
  }

  const MeshDistance& skin_;
  const Route& route_;
  double stature_m_;
};

/// Returns how far inward the fold lies: below the first level that is as deep between the limbs as in them.
/// The largest ball around the deepest point of that level touches the fold.
std::optional<double> fold_height(const Room& room) {
  for (double inward = kStep; inward < kFarthest; inward += kStep) {
    const double between = room.between(inward);
    if (between > kShallow && between >= kAsDeep * room.beside(inward)) return inward - between;
  }
  return std::nullopt;
}

/// Returns how far inward the fold between the thighs lies: below the levels that are as deep between them as
/// in them.
std::optional<double> crotch_height(const Room& room) {
  std::optional<double> first;
  for (double inward = kStep; inward < kFarthest; inward += kStep) {
    const double between = room.between(inward), beside = room.beside(inward);
    if (!first && between > kShallow && between >= kAsDeep * beside) first = inward;
    if (first && between >= kQuiteAsDeep * beside)
      return 0.5 * (*first + inward) - kOpenCrotch - kPerDepth * std::max(0.0, between - kDeepTrunk);
  }
  return std::nullopt;
}

/// Returns how far across the plane between the thighs lies: where there is least room a little above the
/// landmark.
double middle_of(const Room& room) {
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  for (double across = -kAside; across < kAside + 0.5 * kAsideStep; across += kAsideStep) {
    double depth = kOffMiddle * std::abs(across);
    for (const double inward : kNearLevels) depth += room.on_line(inward, across);
    if (depth < least) least = depth, best = across;
  }
  return best;
}

/// The share of the skin around a point that is made up.
double made_up_share(const TriMesh& skin, std::span<const std::uint8_t> made_up, const Vec3& point,
                     double around) {
  const std::vector<Vec3>& positions = skin.positions;
  if (made_up.size() != positions.size()) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : positions) nearest = std::min(nearest, (p - point).norm());
  std::size_t all = 0, sum = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if ((positions[v] - point).norm() > nearest + around) continue;
    ++all;
    sum += made_up[v];
  }
  return static_cast<double>(sum) / static_cast<double>(std::max<std::size_t>(all, 1));
}

/// How much of a web is named.
double least_of(const TriMesh& skin, const Anatomy& found, std::span<const std::uint8_t> made_up,
                const Vec3& point, bool crotch) {
  const bool stands = std::ranges::min(thigh_cosines(found)) >= kUpright;
  const double share = made_up_share(skin, made_up, point, kMadeUpAround * found.stature_m);
  const Least& least = share >= kMadeUpShare ? kMadeUp : stands ? kStanding : kBent;
  return crotch ? least.crotch : least.armpit;
}

/// Moves the route's start to the skin, between the limbs. Returns how far inward from there their fold lies.
std::optional<double> height_along(const engine::Context& context, const TriMesh& skin, const Anatomy& found,
                                   LandmarkId id, Route& route) {
  const bool crotch = id == LandmarkId::kPerineum;
  const MeshDistance near(context, crop(skin, route.from, kAround * found.stature_m));
  if (const auto hit = near.closest_point_within(route.from, kAround * found.stature_m))
    route.from = hit->point;
  if (crotch) route.from += found.stature_m * middle_of(Room(near, route, found.stature_m)) * route.across;
  const Room room(near, route, found.stature_m);
  return crotch ? crotch_height(room) : fold_height(room);
}

std::optional<Web> find_web(const engine::Context& context, const TriMesh& skin, const Anatomy& found,
                            std::span<const std::uint8_t> made_up, LandmarkId id) {
  const bool crotch = id == LandmarkId::kPerineum;
  Route route = route_inward(found, id);
  const std::optional<double> height = height_along(context, skin, found, id, route);
  if (!height || *height < least_of(skin, found, made_up, route.from, crotch)) return std::nullopt;
  return Web{id, route.from, route.from + (*height + kOwnRoom) * found.stature_m * route.inward};
}

/// The fold between thighs that a copy shows parted lies where the skin shows room between them.
Vec3 crotch_fold(const engine::Context& context, const TriMesh& skin, const Anatomy& found, Route route) {
  const MeshDistance near(context, crop(skin, route.from, kAround * found.stature_m));
  route.from -= kTooHigh * found.stature_m * route.inward;
  const std::optional<double> height = crotch_height(Room(near, route, found.stature_m));
  const double above = height ? std::clamp(*height + kOwnRoom, 0.0, kTooHigh + kTooLow) : kTooHigh;
  return route.from + above * found.stature_m * route.inward;
}

}  // namespace

Fold fold_at(const Anatomy& found, LandmarkId id) {
  const Route route = route_inward(found, id);
  return {id, route.from, route.inward};
}

std::optional<double> web_height(const engine::Context& context, const TriMesh& skin, const Anatomy& found,
                                 LandmarkId id) {
  Route route = route_inward(found, id);
  return height_along(context, skin, found, id, route);
}

std::vector<Fold> find_folds(const engine::Context& context, const TriMesh& skin, const Anatomy& found) {
  std::vector<Fold> folds;
  for (const LandmarkId id : kFoldLandmarks) {
    const Route route = route_inward(found, id);
    const bool crotch = id == LandmarkId::kPerineum;
    folds.push_back({id, crotch ? crotch_fold(context, skin, found, route) : route.from, route.inward});
  }
  return folds;
}

std::vector<Web> find_webs(const engine::Context& context, const TriMesh& skin, const Anatomy& found,
                           std::span<const std::uint8_t> made_up) {
  std::vector<Web> webs;
  for (const LandmarkId id : kFoldLandmarks)
    if (const auto web = find_web(context, skin, found, made_up, id)) webs.push_back(*web);
  return webs;
}

}  // namespace bodice::anatomy
