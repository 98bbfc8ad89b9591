#include <algorithm>

#include <bodice/engine/clock.hpp>

#include "cover.hpp"
#include "medial_start.hpp"
#include "scaling.hpp"
#include "tiers.hpp"
#include "tight_descent.hpp"

namespace bodice::fitting {
namespace {

constexpr float kCoveringWeight = 4.0f;  // of uncovered skin, before what is left is covered by growth

/// Every triangle of the wanted, unburied skin into an ellipsoid.
void cover_skin(const engine::Context& context, const SkinSource& source,
                std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
  const LabelledSkin& skin = source.skin;
  std::vector<Index> triangles;
  for (std::size_t t = 0; t < skin.mesh.triangles.size(); ++t) {
    const auto part = static_cast<int>(skin.part[skin.mesh.triangles[t][0]]);
    if (((source.parts >> part) & 1u) && !source.buried[t]) triangles.push_back(static_cast<Index>(t));
  }
  std::vector<geometry::Ellipsoid> shapes;
  for (const auto& e : ellipsoids) shapes.push_back(e.shape);
  cover_triangles(context, skin.mesh, triangles, shapes);
  for (std::size_t k = 0; k < shapes.size(); ++k) ellipsoids[k].shape = shapes[k];
}

}  // namespace

Draft fit_tight(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                int count, double time_budget_s) {
  const LabelledSkin& skin = source.skin;
  const std::int64_t deadline =
      context.clock->now_ns() + static_cast<std::int64_t>(1e9 * std::min(time_budget_s, 1e6));
  Draft draft;
  draft.data.tier = proxy::Tier::kTight;
  draft.parts = source.parts;
  draft.data.ellipsoids = medial_start(context, source, count);
  const Scaling scaling(skin);
  const double mm = scaling.mm();
  const std::size_t samples = std::clamp<std::size_t>(200 * static_cast<std::size_t>(count), 6000, 60000);
  // Less than half on the skin: with more, ellipsoids spread in air that nobody asks about.
  const std::vector<DistanceSample> near_skin =
      sample_near_skin(context, source, {samples, 8 * mm, 20 * mm, 0.45, 0.15, 200 * mm, 11});
  TightLoss loss;
  if (options.covering) loss.uncovered_weight = kCoveringWeight;
  TightProblem problem(near_skin, scaling.origin, scaling.scale, loss);
  std::vector<geometry::Ellipsoid> state;
  for (const auto& e : draft.data.ellipsoids) state.push_back(scaling.in(e.shape));

  const auto take = [&](std::span<const geometry::Ellipsoid> found) {
    for (std::size_t k = 0; k < found.size(); ++k) draft.data.ellipsoids[k].shape = scaling.out(found[k]);
  };
  DescentOptions descent;
  descent.out_of_time = [&] { return context.clock->now_ns() >= deadline; };
  descent.on_improved = [&](std::span<const geometry::Ellipsoid> found) {
    if (!options.on_improved) return;
    take(found);
    proxy::BodyProxy::Data data = draft.data;
    take_parts(problem, near_skin, data.ellipsoids);
    data.stature_m = skin.stature_m;
    data.frame = skin.frame;
    if (auto proxy = proxy::BodyProxy::make(std::move(data))) options.on_improved(*proxy);
  };
  const DescentReport report = descend(context, problem, state, descent);
  take(state);
  take_parts(problem, near_skin, draft.data.ellipsoids);
  for (auto idle = report.idle.rbegin(); idle != report.idle.rend(); ++idle)
    if (draft.data.ellipsoids.size() > 1)
      draft.data.ellipsoids.erase(draft.data.ellipsoids.begin() + static_cast<std::ptrdiff_t>(*idle));
  if (options.covering) cover_skin(context, source, draft.data.ellipsoids);
  return draft;
}

}  // namespace bodice::fitting
