#include <algorithm>
#include <numeric>

#include <bodice/engine/clock.hpp>

#include "base/scaling.hpp"
#include "cover/cover.hpp"
#include "cover/cover_pieces.hpp"
#include "skin/air_samples.hpp"
#include "skin/medial_initialization.hpp"
#include "tiers/tiers.hpp"
#include "tight/descent.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

/// The first steps use one sample in so many and may be long: few samples suffice to find where ellipsoids
/// are needed.
constexpr std::size_t kCoarse = 3;
constexpr int kCoarseIterations = 64, kTightIterations = 48;
constexpr double kCoarseMotion = 0.03,
                 kMotion = 0.012;  // longest motions between refreshes, in the scaled body
/// The last steps use so many times the samples, without split-and-merge moves: a fit to fewer samples is
/// worse by a twentieth on the skin between them.
constexpr std::size_t kFine = 4;
constexpr int kFineIterations = 16;
constexpr double kFineMotion = 0.005;
/// How far samples reach into the body and out of it. Ellipsoids fitted to the skin alone are a third more
/// wrong 2 cm under it, and leave holes there.
constexpr double kInward_mm = 25.0, kOutward_mm = 20.0;
constexpr std::size_t kAirProbes = 8;    // samples for each probe of the union's surface
constexpr float kCoveringWeight = 4.0f;  // weight of uncovered skin, before growth covers the rest

/// All ellipsoids grow by the first before any grows for its triangles, and none shrinks below the second
/// times its fitted size; with less of either, a few ellipsoids have to grow much.
constexpr double kGrowTightFirst_mm = 3.0, kLeastGrown = 1.03;

/// The wanted triangles with a corner outside all other limbs. A triangle that dips into another limb is
/// flagged as buried, but the rest of it bounds the body.
std::vector<Index> open_triangles(const SkinSource& source) {
  const auto& [positions, triangles] = source.skin.mesh;
  std::vector<std::uint8_t> open(positions.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!source.buried[t])
      for (const Index v : triangles[t]) open[v] = 1;
  std::vector<Index> found;
  for (Index t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const auto part = static_cast<int>(source.skin.part[a]);
    if (((source.parts >> part) & 1u) && (open[a] || open[b] || open[c])) found.push_back(t);
  }
  return found;
}

/// Grows the ellipsoids until each open triangle of the wanted skin, or each piece of one, is held.
void cover_skin(const engine::Context& context, const SkinSource& source,
                std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
  const LabeledSkin& skin = source.skin;
  std::vector<geometry::Ellipsoid> shapes, anchors;
  for (const auto& e : ellipsoids) {
    const auto& [center, axes, radii] = e.shape;
    anchors.push_back({center, axes, kLeastGrown * radii});
    shapes.push_back({center, axes, radii.array() + kGrowTightFirst_mm * Scaling(skin).mm()});
  }
  const CoverPieces pieces = cut_at_creases(skin, open_triangles(source), shapes);
  std::vector<Index> all(pieces.mesh.triangles.size());
  std::iota(all.begin(), all.end(), Index{0});
  cover_triangles(context, pieces.mesh, all, shapes);
  relax_cover(context, pieces.mesh, all, anchors, shapes);
  for (std::size_t k = 0; k < shapes.size(); ++k) ellipsoids[k].shape = shapes[k];
}

/// The descent of one draft: on few samples, on all, then on more.
class TightRun {
 public:
  TightRun(const engine::Context& context, const SkinSource& source, const FitOptions& options, Draft& draft,
           std::int64_t deadline_ns)
      : context_(context), source_(source), options_(options), draft_(draft), scaling_(source.skin) {
    descent_.out_of_time = [this, deadline_ns] { return context_.clock->now_ns() >= deadline_ns; };
    descent_.more_samples = [this](std::span<const geometry::Ellipsoid> found) { return in_air(found); };
    loss_.ignore_depth = static_cast<float>(1e-3 * kInward_mm);
    if (options.covering) loss_.uncovered_weight = kCoveringWeight;
  }

  void run(std::size_t count) {
    std::vector<geometry::Ellipsoid> state;
    for (const auto& e : draft_.data.ellipsoids) state.push_back(scaling_.in(e.shape));
    std::vector<DistanceSample> samples = drawn(count, 11), few;
    air_probes_ = samples.size() / kAirProbes;
    for (std::size_t i = 0; i < samples.size(); i += kCoarse) few.push_back(samples[i]);
    descend_on(few, kCoarseMotion, kCoarseIterations, state);
    std::vector<std::size_t> idle = descend_on(samples, kMotion, kTightIterations, state);
    if (!descent_.out_of_time()) {
      const std::vector<DistanceSample> more = drawn((kFine - 1) * count, 12);
      samples.insert(samples.end(), more.begin(), more.end());
      air_probes_ = samples.size() / kAirProbes;
      descent_.split_and_merge = false;
      idle = descend_on(samples, kFineMotion, kFineIterations, state);
    }
    for (auto k = idle.rbegin(); k != idle.rend(); ++k)  // clang 14 does not take libstdc++'s views
      if (draft_.data.ellipsoids.size() > 1)
        draft_.data.ellipsoids.erase(draft_.data.ellipsoids.begin() + static_cast<std::ptrdiff_t>(*k));
  }

 private:
  /// Draws samples, less than a third of them on the skin: with more, ellipsoids spread in air that has no
  /// samples.
  std::vector<DistanceSample> drawn(std::size_t count, std::uint64_t seed) const {
    const double mm = scaling_.mm();
    return sample_near_skin(context_, source_,
                            {count, kInward_mm * mm, kOutward_mm * mm, 0.3, 0.15, 200 * mm, seed});
  }

  /// Returns the indices of the ellipsoids that hold no skin, ascending.
  std::vector<std::size_t> descend_on(std::span<const DistanceSample> samples, double motion, int iterations,
                                      std::vector<geometry::Ellipsoid>& state) {
    LeastSquaresProblem problem(samples, scaling_, loss_, motion);
    descent_.iterations = iterations;
    if (options_.on_improved)
      descent_.on_improved = [&](std::span<const geometry::Ellipsoid> found) { publish(problem, found); };
    std::vector<std::size_t> idle = descend(context_, problem, state, descent_);
    take(state);
    take_parts(problem, draft_.data.ellipsoids);
    return idle;
  }

  /// Stores scaled ellipsoids in the draft.
  void take(std::span<const geometry::Ellipsoid> found) {
    for (std::size_t k = 0; k < found.size(); ++k) draft_.data.ellipsoids[k].shape = scaling_.out(found[k]);
  }

  void publish(const LeastSquaresProblem& problem, std::span<const geometry::Ellipsoid> found) {
    take(found);
    proxy::BodyProxy::Data data = draft_.data;
    take_parts(problem, data.ellipsoids);
    data.stature_m = source_.skin.stature_m;
    data.frame = source_.skin.frame;
    if (auto proxy = proxy::BodyProxy::make(std::move(data))) options_.on_improved(*proxy);
  }

  std::vector<DistanceSample> in_air(std::span<const geometry::Ellipsoid> found) const {
    std::vector<geometry::Ellipsoid> shapes;
    for (const auto& e : found) shapes.push_back(scaling_.out(e));
    const double mm = scaling_.mm();
    return samples_in_air(context_, source_, shapes, air_probes_, 8.0 * mm, 200.0 * mm);
  }

  const engine::Context& context_;
  const SkinSource& source_;
  const FitOptions& options_;
  Draft& draft_;
  Scaling scaling_;
  RobustLoss loss_;
  DescentOptions descent_;
  std::size_t air_probes_ = 0;
};

}  // namespace

Draft fit_tight(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                int count, double time_budget_s) {
  const std::int64_t deadline_ns =
      context.clock->now_ns() + static_cast<std::int64_t>(1e9 * std::min(time_budget_s, 1e6));
  Draft draft;
  draft.data.tier = proxy::Tier::kTight;
  draft.parts = source.parts;
  draft.data.ellipsoids = medial_initialization(context, source, count);
  TightRun(context, source, options, draft, deadline_ns)
      .run(std::clamp<std::size_t>(250 * static_cast<std::size_t>(count), 7500, 75000));
  if (options.covering) cover_skin(context, source, draft.data.ellipsoids);
  return draft;
}

}  // namespace bodice::fitting
