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
constexpr unsigned kBody = kScale | kOffset;  // the aspect of a human body is fixed
constexpr double kBall = 0.3;                 // radius of the ball under the sheet, in sizes
constexpr int kVertices = 1500, kEllipsoids = 24;

/// A body at the origin, in meters; errors compare a scaled and moved copy of it with the original.
class BodyAtOrigin {
 public:
  BodyAtOrigin() : body_(synth::make_body({}, {.vertices = kVertices}).value()) {}

  /// The largest distance between a landmark of the copy, mapped back to the original, and the landmark that
  /// the original gives.
  double landmark_error(const Placement& placement) const {
    const auto origin = anatomy::analyze({}, body_.mesh, {.profile = profile_});
    const auto there = anatomy::analyze({}, at(placement), {.profile = profile_});
    if (!origin || !there) return kRefused;
    double worst = 0.0;
    for (std::size_t k = 0; k < origin->landmarks.size(); ++k) {
      const Vec3 back = to_origin(there->landmarks[k].position, placement);
      worst = std::max(worst, (back - origin->landmarks[k].position).norm());
    }
    return worst / body_.stature_m;
  }

  double label_error(const Placement& placement) const {
    const auto origin = anatomy::analyze({}, body_.mesh, {.profile = profile_});
    const auto there = anatomy::analyze({}, at(placement), {.profile = profile_});
    if (!origin || !there) return kRefused;
    std::size_t other = 0;
    for (std::size_t v = 0; v < origin->part.size(); ++v) other += origin->part[v] != there->part[v];
    return static_cast<double>(other) / static_cast<double>(origin->part.size());
  }

  double gap_error(const Placement& placement, proxy::Tier tier) {
    if (!gap_.contains(tier)) gap_[tier] = gap(body_.mesh, 1.0, tier);
    const double there = gap(at(placement), placement.scale_m / body_.stature_m, tier);
    return std::abs(there - gap_[tier]) / gap_[tier];
  }

 private:
  /// The copy. It stays upright, because anatomy expects an upright body.
  TriMesh at(const Placement& placement) const {
    TriMesh mesh = body_.mesh;
    for (Vec3& p : mesh.positions) p = placement.scale_m / body_.stature_m * p + placement.center_m();
    return mesh;
  }
  Vec3 to_origin(const Vec3& p, const Placement& placement) const {
    return (p - placement.center_m()) * (body_.stature_m / placement.scale_m);
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

/// Drops a cotton sheet on a ball for half a second, in gravity proportional to the scale. Returns its
/// vertices relative to the ball's center; empty if an input is refused or a position is not finite.
std::vector<Vec3> drape(const Placement& placement) {
  constexpr int kCells = 12, kFrames = 30;
  const geometry::Ellipsoid ball{placement.center_m(), geometry::Mat3::Identity(),
                                 kBall * placement.extents_m()};
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
                                placement.scale_m * (Vec3(i, 0.0, j) / kCells - Vec3(0.5, -0.32, 0.5)));
  for (geometry::Index j = 0; j < kCells; ++j)
    for (geometry::Index i = 0; i < kCells; ++i) {
      const geometry::Index a = j * (kCells + 1) + i, c = a + kCells + 1;
      sheet.triangles.push_back({a, c, a + 1});
      sheet.triangles.push_back({a + 1, c, c + 1});
    }
  cloth::SolverOptions options;
  options.thickness_m = 1e-3 * placement.scale_m;
  options.environment.gravity_m_s2 *= placement.scale_m;
  auto solver = cloth::Solver::make(sheet, {}, cloth::find_fabric("cotton").value(), options);
  if (!solver) return {};
  for (int frame = 0; frame < kFrames; ++frame)
    if (!solver->step({}, collider, 1.0 / 60.0).finite) return {};
  std::vector<Vec3> now(sheet.positions.size());
  solver->positions(now);
  for (Vec3& p : now) p -= ball.center;
  return now;
}

double depth_in_ball(const Placement& placement) {
  const geometry::Ellipsoid ball{Vec3::Zero(), geometry::Mat3::Identity(), kBall * placement.extents_m()};
  const auto sheet = drape(placement);
  double depth = sheet.empty() ? kRefused : 0.0;
  for (const Vec3& p : sheet) depth = std::max(depth, -geometry::closest_point(ball, p).signed_distance);
  return depth / placement.scale_m;
}

/// The largest distance between a vertex of the sheet and the same vertex of the same scene at the origin.
double moved_by_offset(const Placement& placement) {
  Placement at_origin = placement;
  at_origin.offset = 0.0;
  const auto moved = drape(placement), original = drape(at_origin);
  if (moved.empty() || moved.size() != original.size()) return kRefused;
  double worst = 0.0;
  for (std::size_t v = 0; v < moved.size(); ++v) worst = std::max(worst, (moved[v] - original[v]).norm());
  return worst / placement.scale_m;
}

}  // namespace

std::vector<Curve> body_curves() {
  using proxy::Tier;
  const auto origin = std::make_shared<BodyAtOrigin>();
  std::vector<Curve> curves = {{"anatomy::analyze", "landmark moved, to stature",
                                [=](const Placement& p) { return origin->landmark_error(p); }, kBody},
                               {"anatomy::analyze", "share of vertices with another part",
                                [=](const Placement& p) { return origin->label_error(p); }, kBody}};
  for (const Tier tier : {Tier::kPaper, Tier::kSolid, Tier::kTight, Tier::kRelief})
    curves.push_back({"fit, " + std::string(proxy::name(tier)), "change of the mean gap, to itself",
                      [=](const Placement& p) { return origin->gap_error(p, tier); }, kBody});
  curves.push_back({"cloth::Solver", "depth inside the body, to size", depth_in_ball});
  curves.push_back({"cloth::Solver", "change of a vertex from the same scene at the origin, to size",
                    moved_by_offset, kOffset});
  return curves;
}

}  // namespace extremes_bench
