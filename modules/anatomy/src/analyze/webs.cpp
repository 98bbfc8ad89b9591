#include "analyze/webs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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
constexpr double kAhead = 0.084, kAheadStep = 0.012;  ///< where the thickest point of a level is looked for
constexpr double kShallow = 0.015;                    ///< what lies less deep shows no fold
constexpr std::array kLimbs{0.03, 0.045};             ///< from the plane to the middles of the limbs
/// The plane is above the fold where it has at least this share of the room beside it.
constexpr double kAsDeep = 0.9;
/// The least room of a web; whole bodies have less, with straight thighs and with bent ones: of 235 that
/// stand 229 have less than .019 at the crotch and all but one less at the armpits, of 179 others all but
/// one. Thighs of heavy bodies that meet have up to .022; a landmark that is off by less than .03 counts as
/// right.
struct Least {
  double crotch, armpit;
};
constexpr Least kStanding{0.026, 0.013}, kBent{0.035, 0.025};
/// A body stands if the cosines of both thighs reach this.
constexpr double kUpright = 0.75;

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

}  // namespace

std::vector<Web> find_webs(const engine::Context& context, const TriMesh& skin, const Anatomy& found) {
  std::vector<Web> webs;
  const Least& least = std::ranges::min(thigh_cosines(found)) < kUpright ? kBent : kStanding;
  for (const LandmarkId id : {LandmarkId::kArmpitL, LandmarkId::kArmpitR, LandmarkId::kPerineum}) {
    Route route = route_inward(found, id);
    const MeshDistance near(context, crop(skin, route.from, kAround * found.stature_m));
    if (const auto hit = near.closest_point_within(route.from, kAround * found.stature_m))
      route.from = hit->point;
    const std::optional<double> height = fold_height(Room(near, route, found.stature_m));
    if (!height || *height < (id == LandmarkId::kPerineum ? least.crotch : least.armpit)) continue;
    webs.push_back({id, route.from, route.from + *height * found.stature_m * route.inward, route.forward});
  }
  return webs;
}

}  // namespace bodice::anatomy
