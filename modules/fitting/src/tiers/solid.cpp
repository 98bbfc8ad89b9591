// Tier solid. Every region is fitted on its own, from its own skin: medial clusters, a short descent, and
// growth until an ellipsoid holds each triangle whole. Then the interior is closed, which concerns all
// regions together.
#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/scaling.hpp"
#include "cluster/cluster_items.hpp"
#include "cover/cover.hpp"
#include "skin/air_samples.hpp"
#include "skin/medial_initialization.hpp"
#include "skin/part_skin.hpp"
#include "tiers/tiers.hpp"
#include "tight/descent.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr double kOverStepOfFew = 1.3;  // over-relaxation of the steps, of which there are few
constexpr int kSolidIterations = 9;     // steps of the descent: too few for split-and-merge moves to pay
/// Steps after the samples in the air are added, which are the union's points more than kStandsOut_mm outside
/// the skin. Without them a long ellipsoid that follows flat skin may stand decimeters out behind a hollow.
constexpr int kAirIterations = 4;
constexpr double kStandsOut_mm = 15.0, kFarInAir_mm = 200.0;
constexpr std::size_t kAirProbesEach = 40;  // probes of an ellipsoid's surface, of the average size
/// Motion in the scaled body up to which candidates stay valid. With so few samples and ellipsoids a region,
/// choosing candidates again costs more than keeping all that may ever be near.
constexpr double kMostSolidMotion = 0.3;
constexpr int kCandidates = 6;            // candidates a sample: more of them change only the time
constexpr std::size_t kSamplesEach = 45;  // skin samples an ellipsoid
constexpr double kColumnSpacing = 4e-3;   // fraction of stature: 7 mm, finer than any cavity worth a particle
constexpr float kUncoveredWeight =
    3.0f;  // skin outside weighs more, because growth costs more than some overlap
constexpr double kGrowSolidFirst_mm = 2.0;  // growth of all ellipsoids before any grows for its triangles
/// With up to so many ellipsoids in a region, enclosing clusters of triangles may take less volume than
/// growing.
constexpr int kFewEllipsoids = 2;

/// How many of `count` ellipsoids each region gets, by the sum of its balls' demands.
std::vector<int> shares_by_demand(const std::vector<PartSkin>& skins, int count, double stature_m) {
  std::vector<double> need(skins.size(), 0.0);
  for (std::size_t r = 0; r < skins.size(); ++r)
    for (const InscribedBall& ball : skins[r].balls) need[r] += demand(ball, stature_m);
  std::vector<int> share(skins.size(), 1);
  for (int left = count - static_cast<int>(skins.size()); left > 0; --left) {
    std::size_t best = 0;
    for (std::size_t r = 1; r < share.size(); ++r)
      if (need[r] / (share[r] + 0.5) > need[best] / (share[best] + 0.5)) best = r;
    ++share[best];
  }
  return share;
}

/// Whether the longest axis of any ellipsoid ends in the air, which is far sooner known than samples are
/// found.
bool any_end_in_air(const SkinSource& source, const Scaling& scaling,
                    std::span<const geometry::Ellipsoid> shapes) {
  const geometry::MeshDistance& distance = *source.skin.distance;
  for (const geometry::Ellipsoid& scaled : shapes) {
    const geometry::Ellipsoid e = scaling.out(scaled);
    Eigen::Index longest = 0;
    const double radius_m = e.radii.maxCoeff(&longest);
    const Vec3 half_axis = radius_m * e.axes.col(longest);
    for (const Vec3& end : {Vec3(e.center - half_axis), Vec3(e.center + half_axis)})
      if (!distance.closest_point_within(end, kStandsOut_mm * scaling.mm()) && !distance.inside(end))
        return true;
  }
  return false;
}

/// Samples of the air in which the ellipsoids, in the scaled body, stand out.
std::vector<DistanceSample> air_of(const engine::Context& context, const SkinSource& source,
                                   const Scaling& scaling, std::span<const geometry::Ellipsoid> shapes) {
  std::vector<geometry::Ellipsoid> in_meters;
  for (const geometry::Ellipsoid& e : shapes) in_meters.push_back(scaling.out(e));
  return samples_in_air(context, source, in_meters, kAirProbesEach * shapes.size(),
                        kStandsOut_mm * scaling.mm(), kFarInAir_mm * scaling.mm());
}

/// Ellipsoids that follow one region's skin, in meters.
std::vector<proxy::ProxyEllipsoid> follow(const engine::Context& context, const SkinSource& source,
                                          const std::vector<PartSkin>& skins, std::size_t r, int count) {
  const LabeledSkin& skin = source.skin;
  auto ellipsoids = ellipsoids_from_balls(context, skins[r].balls, count, skin.stature_m);
  const Scaling scaling(skin);
  const RobustLoss loss{.huber = 0.002f, .uncovered_huber = 0.004f, .uncovered_weight = kUncoveredWeight};
  const std::vector<DistanceSample> samples = part_samples(skins, r, skin.stature_m);
  LeastSquaresProblem problem(samples, scaling, loss, kMostSolidMotion, kCandidates);
  std::vector<geometry::Ellipsoid> shapes;
  for (const auto& e : ellipsoids) shapes.push_back(scaling.in(e.shape));
  if (shapes.empty()) return ellipsoids;
  DescentOptions steps{.iterations = kSolidIterations, .split_and_merge = false, .over_step = kOverStepOfFew};
  descend(context, problem, shapes, steps);
  std::vector<DistanceSample> air;
  if (any_end_in_air(source, scaling, shapes)) air = air_of(context, source, scaling, shapes);
  if (!air.empty()) {
    problem.add(air);
    steps.iterations = kAirIterations;
    descend(context, problem, shapes, steps);
  }
  for (std::size_t k = 0; k < shapes.size(); ++k) ellipsoids[k].shape = scaling.out(shapes[k]);
  take_parts(problem, ellipsoids);
  return ellipsoids;
}

/// The ellipsoid of a region that is too small to have samples: it starts at one vertex and grows by the
/// cover.
proxy::ProxyEllipsoid speck(const Items& items, const Region& region, double stature_m) {
  proxy::ProxyEllipsoid e;
  e.part = items.part[region.items.front()];
  e.shape.center = items.where[region.items.front()];
  e.shape.radii.setConstant(kLeastRadius * stature_m);
  return e;
}

/// Grows a region's ellipsoids until each of its triangles is held.
FittedRegion cover_region(const engine::Context& context, const LabeledSkin& skin, const Items& items,
                          const Region& region, std::vector<proxy::ProxyEllipsoid> ellipsoids) {
  if (ellipsoids.empty()) ellipsoids.push_back(speck(items, region, skin.stature_m));
  std::vector<geometry::Ellipsoid> shapes;
  const double first = kGrowSolidFirst_mm * Scaling(skin).mm();
  for (const auto& e : ellipsoids)
    shapes.push_back({e.shape.center, e.shape.axes, e.shape.radii.array() + first});
  std::vector<Index> triangles;
  for (const Index i : region.items) triangles.push_back(items.triangle[i]);
  cover_triangles(context, skin.mesh, triangles, shapes);
  for (std::size_t k = 0; k < shapes.size(); ++k) ellipsoids[k].shape = shapes[k];
  return {std::move(ellipsoids), {}};
}

/// Enclosing ellipsoids of bisected clusters of whole triangles.
FittedRegion enclose_region(const engine::Context& context, const Items& items, const Region& region,
                            int count, double stature_m) {
  Region from = region;
  if (static_cast<int>(from.seeds.size()) > count) from.seeds = {items.where[region.items.front()]};
  Refinement refinement(context, items, from, refine_options(stature_m));
  refinement.run(0.0, static_cast<std::size_t>(count));
  FittedRegion fitted;
  for (const Cluster& c : refinement.clusters()) fitted.ellipsoids.push_back({c.ellipsoid, c.part});
  return fitted;
}

double total_volume(const FittedRegion& fitted) {
  double sum = 0.0;
  for (const auto& e : fitted.ellipsoids) sum += geometry::volume(e.shape);
  return sum;
}

InteriorColumns columns_of(const LabeledSkin& skin) {
  return interior_columns(skin.mesh, kColumnSpacing * skin.stature_m);
}

/// Fits all regions. If `columns` is not null, they are found while the skin is sampled.
engine::Result<std::vector<FittedRegion>> cover_regions(const engine::Context& context,
                                                        const LabeledSkin& skin, const RegionItems& items,
                                                        int count, const FitOptions& options,
                                                        InteriorColumns* columns) {
  const std::vector<Region>& regions = items.regions;
  std::vector<PartSkin> skins;
  // Which skin is buried in other limbs is not found here, because that takes longer than the fit.
  const SkinSource source{skin, kAllParts, std::vector<std::uint8_t>(skin.mesh.triangles.size(), 0)};
  RegionTasks tasks{.verb = "cover"};
  tasks.parts = options.parts;
  tasks.on_part = options.on_part;
  tasks.share = [&](const engine::Context& inner) {
    const std::size_t samples = kSamplesEach * static_cast<std::size_t>(count);
    engine::parallel_for(inner, columns ? 2 : 1, 1, [&](std::size_t job, std::size_t) {
      if (job == 0)
        skins = sample_parts(inner, skin, regions, std::clamp<std::size_t>(samples, 1500, 20000));
      else
        *columns = columns_of(skin);
    });
    return shares_by_demand(skins, count, skin.stature_m);
  };
  tasks.fit = [&](const engine::Context& inner, const Region& region, int share) {
    const auto r = static_cast<std::size_t>(&region - regions.data());
    std::vector<proxy::ProxyEllipsoid> ellipsoids;
    if (!skins[r].balls.empty()) ellipsoids = follow(inner, source, skins, r, share);
    FittedRegion covered = cover_region(inner, skin, items.all, region, std::move(ellipsoids));
    if (share > kFewEllipsoids) return covered;
    FittedRegion enclosed = enclose_region(inner, items.all, region, share, skin.stature_m);
    return total_volume(enclosed) < total_volume(covered) ? enclosed : covered;
  };
  return run_region_tasks(context, regions, tasks);
}

/// Grows ellipsoids until the union holds the interior.
void close_inside(const engine::Context& context, const LabeledSkin& skin, const InteriorColumns& columns,
                  std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
  std::vector<geometry::Ellipsoid> shapes;
  for (const auto& e : ellipsoids) shapes.push_back(e.shape);
  cover_interior(context, columns, *skin.distance, shapes);
  for (std::size_t k = 0; k < shapes.size(); ++k) ellipsoids[k].shape = shapes[k];
}

}  // namespace

engine::Result<Draft> fit_solid(const engine::Context& context, const LabeledSkin& skin,
                                const FitOptions& options, int count) {
  RegionItems items{.all = triangle_items(context, skin), .regions = {}};
  items.regions = make_regions(items.all, count);
  const Thresholds mu{options.mu_torso_m.value_or(0.0), options.mu_limbs_m.value_or(0.0)};
  Draft draft;
  draft.data.tier = proxy::Tier::kSolid;
  // The interior is closed for whole bodies only: some regions alone have no interior of their own.
  draft.parts = fitted_parts(items.regions, options.parts);
  const bool whole = draft.parts == fitted_parts(items.regions, kAllParts);
  InteriorColumns columns;
  if (whole && mu.given()) columns = columns_of(skin);
  const auto fitted = mu.given()
                          ? refine_regions(context, items, refine_options(skin.stature_m), mu, count, options)
                          : cover_regions(context, skin, items, count, options, whole ? &columns : nullptr);
  if (!fitted) return fitted.error();
  if (mu.given()) report_clusters(*fitted, mu, draft);
  for (const FittedRegion& f : *fitted)
    draft.data.ellipsoids.insert(draft.data.ellipsoids.end(), f.ellipsoids.begin(), f.ellipsoids.end());
  if (whole) close_inside(context, skin, columns, draft.data.ellipsoids);
  return draft;
}

}  // namespace bodice::fitting
