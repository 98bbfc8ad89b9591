#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/cloth/solver.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>

#include "curve.hpp"

namespace extremes_bench {
namespace {

using namespace bodice;
using geometry::TriMesh;
using geometry::Vec3;

constexpr double kRefused = std::numeric_limits<double>::infinity();
constexpr unsigned kBody = kScale | kOffset;  // a human body has but one aspect
constexpr double kBall = 0.3;                 // radius of what the sheet falls on, in sizes
constexpr int kVertices = 1500, kEllipsoids = 24;

/// One body and what is found where it was made.
class Home {
 public:
  Home() : body_(synth::make_body({}, {.vertices = kVertices}).value()) {}

  /// Landmarks found elsewhere, carried back.
  double landmark_error(const Place& place) const {
    const auto home = anatomy::analyze({}, body_.mesh, {.profile = profile_});
    const auto there = anatomy::analyze({}, at(place), {.profile = profile_});
    if (!home || !there) return kRefused;
    double worst = 0.0;
    for (std::size_t k = 0; k < home->landmarks.size(); ++k) {
      const Vec3 back = back_home(there->landmarks[k].position, place);
      worst = std::max(worst, (back - home->landmarks[k].position).norm());
    }
    return worst / body_.stature_m;
  }

  double label_error(const Place& place) const {
    const auto home = anatomy::analyze({}, body_.mesh, {.profile = profile_});
    const auto there = anatomy::analyze({}, at(place), {.profile = profile_});
    if (!home || !there) return kRefused;
    std::size_t other = 0;
    for (std::size_t v = 0; v < home->part.size(); ++v) other += home->part[v] != there->part[v];
    return static_cast<double>(other) / static_cast<double>(home->part.size());
  }

  double gap_error(const Place& place, proxy::Tier tier) {
    if (!gap_.contains(tier)) gap_[tier] = gap(body_.mesh, 1.0, tier);
    const double there = gap(at(place), place.scale_m / body_.stature_m, tier);
    return std::abs(there - gap_[tier]) / gap_[tier];
  }

 private:
  /// Standing upright: what is swept is not the turn.
  TriMesh at(const Place& place) const {
    TriMesh mesh = body_.mesh;
    for (Vec3& p : mesh.positions) p = place.scale_m / body_.stature_m * p + place.center_m();
    return mesh;
  }
  Vec3 back_home(const Vec3& p, const Place& place) const {
    return (p - place.center_m()) * (body_.stature_m / place.scale_m);
  }
  double gap(const TriMesh& mesh, double scale, proxy::Tier tier) const {
    const auto found = fitting::fit({}, {mesh, body_.part, scale * body_.stature_m},
                                    {.tier = tier, .max_ellipsoids = kEllipsoids});
    return found ? found->accuracy.gap_m.mean / scale : kRefused;
  }

  synth::Body body_;
  body::ProportionProfile profile_ = body::find_profile("ansur2").value();
  std::map<proxy::Tier, double> gap_;
};

/// A cotton sheet falls on a ball for half a second, in a gravity of its scale: where its vertices are then,
/// from the ball's center. Nothing if it is refused or does not stay finite.
std::vector<Vec3> drape(const Place& place) {
  constexpr int kCells = 12, kFrames = 30;
  const geometry::Ellipsoid ball{place.center_m(), geometry::Mat3::Identity(), kBall * place.extents_m()};
  proxy::BodyProxy::Data data;
  data.stature_m = 2.0 * ball.radii.maxCoeff();
  data.ellipsoids = {{ball}};
  const auto proxy = proxy::BodyProxy::make(std::move(data));
  if (!proxy) return {};
  const collision::Collider collider(*proxy);
  TriMesh sheet;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i)
      sheet.positions.push_back(ball.center +
                                place.scale_m * (Vec3(i, 0.0, j) / kCells - Vec3(0.5, -0.32, 0.5)));
  for (geometry::Index j = 0; j < kCells; ++j)
    for (geometry::Index i = 0; i < kCells; ++i) {
      const geometry::Index a = j * (kCells + 1) + i, c = a + kCells + 1;
      sheet.triangles.push_back({a, c, a + 1});
      sheet.triangles.push_back({a + 1, c, c + 1});
    }
  cloth::SolverOptions options;
  options.thickness_m = 1e-3 * place.scale_m;
  options.environment.gravity_m_s2 *= place.scale_m;
  auto solver = cloth::Solver::make(sheet, {}, cloth::find_fabric("cotton").value(), options);
  if (!solver) return {};
  for (int frame = 0; frame < kFrames; ++frame)
    if (!solver->step({}, collider, 1.0 / 60.0).finite) return {};
  std::vector<Vec3> now(sheet.positions.size());
  solver->positions(now);
  for (Vec3& p : now) p -= ball.center;
  return now;
}

double depth_in_ball(const Place& place) {
  const geometry::Ellipsoid ball{Vec3::Zero(), geometry::Mat3::Identity(), kBall * place.extents_m()};
  const auto sheet = drape(place);
  double depth = sheet.empty() ? kRefused : 0.0;
  for (const Vec3& p : sheet) depth = std::max(depth, -geometry::closest_point(ball, p).signed_distance);
  return depth / place.scale_m;
}

/// Against the same scene at the origin.
double moved_by_offset(const Place& place) {
  Place home = place;
  home.offset = 0.0;
  const auto here = drape(place), there = drape(home);
  if (here.empty() || here.size() != there.size()) return kRefused;
  double worst = 0.0;
  for (std::size_t v = 0; v < here.size(); ++v) worst = std::max(worst, (here[v] - there[v]).norm());
  return worst / place.scale_m;
}

}  // namespace

std::vector<Curve> body_curves() {
  using proxy::Tier;
  const auto home = std::make_shared<Home>();
  std::vector<Curve> curves = {{"anatomy::analyze", "landmark moved, to stature",
                                [=](const Place& p) { return home->landmark_error(p); }, kBody},
                               {"anatomy::analyze", "share of vertices with another part",
                                [=](const Place& p) { return home->label_error(p); }, kBody}};
  for (const Tier tier : {Tier::kPaper, Tier::kSolid, Tier::kTight, Tier::kRelief})
    curves.push_back({"fit, " + std::string(proxy::name(tier)), "mean gap, to that at home",
                      [=](const Place& p) { return home->gap_error(p, tier); }, kBody});
  curves.push_back({"cloth::Solver", "depth inside the body, to size", depth_in_ball});
  curves.push_back({"cloth::Solver", "a vertex from where it is at home, to size", moved_by_offset, kOffset});
  return curves;
}

}  // namespace extremes_bench
