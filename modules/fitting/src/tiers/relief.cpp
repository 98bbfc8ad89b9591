#include "tiers/relief.hpp"

#include <algorithm>
#include <array>

#include <bodice/engine/clock.hpp>
#include <bodice/engine/stage_timer.hpp>

#include "relief/relief_fit.hpp"
#include "relief/relief_holes.hpp"
#include "tiers/flexed.hpp"
#include "tiers/tiers.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

/// Skin points, samples a point, and steps of the solver: for the first tables, which are there soon and show
/// where more texels pay, and for the final ones.
constexpr std::size_t kFirstNormals = 8000, kNormals = 28000;
constexpr int kFirstPerNormal = 3, kPerNormal = 4;
constexpr int kFirstTableSteps = 16, kTableSteps = 24;
/// The margin, a fraction of stature: it turns most misses of a tenth of a millimeter into hits.
constexpr double kMargin = 0.1e-3 / 1.7;
/// The spacing of interior samples, a fraction of stature: it finds every hole that a thumb fits into.
constexpr double kInsideSpacing = 0.010 / 1.7;
/// The most leaks around which samples are added; posed bodies with interpenetrating limbs have hundreds.
constexpr std::size_t kMostLeaks = 2000;
/// A hole lies deeper than the first fraction of stature, and the tables report it less deep than the second.
constexpr double kHoleDepth = 7e-3 / 1.7, kHoleMargin = 2e-3 / 1.7;

/// The same ellipsoid with its axes by falling radius, over which tables are read the fastest.
geometry::Ellipsoid with_sorted_axes(const geometry::Ellipsoid& e) {
  const std::array<int, 3> order = geometry::axes_by_radius(e.radii);
  geometry::Ellipsoid sorted = e;
  sorted.radii = e.radii(order);
  sorted.axes = e.axes(Eigen::all, order);
  if (sorted.axes.determinant() < 0.0) sorted.axes.col(2) = -sorted.axes.col(2);
  return sorted;
}

}  // namespace

ReliefTables::ReliefTables(const engine::Context& context, const SkinSource& source,
                           proxy::BodyProxy::Data& data)
    : context_(context), skin_(context, source), data_(data) {
  data_.tier = proxy::Tier::kRelief;
  data_.stature_m = source.skin.stature_m;
  data_.frame = source.skin.frame;
  data_.margin_m = kMargin * data_.stature_m;
  for (proxy::ProxyEllipsoid& e : data_.ellipsoids) e.shape = with_sorted_axes(e.shape);
}

std::vector<ReliefSample> ReliefTables::samples(const ReliefSampling& sampling, double spacing_m) const {
  auto samples = sample_along_normals(context_, skin_, sampling);
  if (spacing_m > 0.0) {
    const double reach_m = proxy::relief_reach(data_.stature_m).in_m;
    const auto inside = sample_inside(context_, skin_, spacing_m, reach_m);
    samples.insert(samples.end(), inside.begin(), inside.end());
  }
  return samples;
}

ReliefTerms ReliefTables::terms_of(std::span<const ReliefSample> samples) const {
  return find_terms(context_, samples, data_.ellipsoids, proxy::relief_reach(data_.stature_m));
}

ReliefTerms ReliefTables::terms_around(std::span<const std::uint32_t> leaks) {
  std::vector<Vec3> points =
      find_holes(context_, skin_, data_, kHoleDepth * data_.stature_m, kHoleMargin * data_.stature_m);
  for (const std::uint32_t leak : leaks) points.push_back(samples_[leak].point);
  points.resize(std::min(points.size(), kMostLeaks));
  const auto more = sample_around(context_, skin_, points, kInsideSpacing * data_.stature_m,
                                  proxy::relief_reach(data_.stature_m).in_m);
  samples_.insert(samples_.end(), more.begin(), more.end());
  return terms_of(more);
}

void ReliefTables::fit_first(std::size_t bytes) {
  const std::size_t ellipsoids = data_.ellipsoids.size();
  const double reach_m = proxy::relief_reach(data_.stature_m).out_m;
  ReliefTerms terms = terms_of(samples({kFirstNormals, kFirstPerNormal, reach_m, 21}, 0.0));
  const auto sides = equal_sides(ellipsoids, texels_within(ellipsoids, bytes));
  error_ = fit_tables(context_, terms, sides, kFirstTableSteps, data_);
}

void ReliefTables::fit(std::size_t bytes) {
  const double reach_m = proxy::relief_reach(data_.stature_m).out_m;
  if (samples_.empty()) {
    samples_ = samples({kNormals, kPerNormal, reach_m, 22}, kInsideSpacing * data_.stature_m);
    terms_ = terms_of(samples_);
  }
  const auto sides = shared_sides(error_, texels_within(data_.ellipsoids.size(), bytes));
  const auto more_terms = [&](std::span<const std::uint32_t> leaks) { return terms_around(leaks); };
  fit_tables(context_, terms_, sides, kTableSteps, data_, more_terms);
}

ReliefRun::ReliefRun(const engine::Context& context, const LabeledSkin& skin, const FitOptions& options,
                     const Plan& plan, std::vector<engine::StageTime>& stages)
    : context_(context), stages_(stages), count_(plan.count) {
  const double budget_s = options.time_budget_s.value_or(kNoTimeLimit_s);
  const std::int64_t deadline =
      context.clock->now_ns() + static_cast<std::int64_t>(1e9 * std::min(budget_s, kNoTimeLimit_s));
  engine::StageTimer tight(context, stages, "tight");
  source_ = std::make_unique<SkinSource>(make_skin_source(context, skin, options.parts));
  draft_ = options.flexed.empty() ? fit_tight(context, *source_, options, plan.count, 0.5 * budget_s)
                                  : fit_tight_flexed(context, *source_, options, plan.count, 0.5 * budget_s);
  tight.stop();
  if (draft_.data.ellipsoids.empty()) return;
  engine::StageTimer relief(context, stages, "relief");
  if (texels_within(draft_.data.ellipsoids.size(), share_of(plan.relief_bytes)) == 0) return;
  draft_.data.stature_m = skin.stature_m;
  draft_.data.frame = skin.frame;
  tables_ = std::make_unique<ReliefTables>(context, *source_, draft_.data);
  tables_->fit_first(share_of(plan.relief_bytes));
  if (options.on_improved)
    if (auto proxy = proxy::BodyProxy::make(draft_.data)) options.on_improved(*proxy);
  if (context.clock->now_ns() < deadline) tables_->fit(share_of(plan.relief_bytes));
}

std::size_t ReliefRun::share_of(std::size_t bytes) const {
  if (draft_.parts == kAllParts) return bytes;
  return bytes * draft_.data.ellipsoids.size() / static_cast<std::size_t>(count_);
}

void ReliefRun::resize(std::size_t bytes) {
  if (!tables_ || texels_within(draft_.data.ellipsoids.size(), share_of(bytes)) == 0) return;
  engine::StageTimer relief(context_, stages_, "relief");
  tables_->fit(share_of(bytes));
}

}  // namespace bodice::fitting
