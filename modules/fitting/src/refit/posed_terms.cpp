#include "refit/posed_terms.hpp"

#include <algorithm>
#include <limits>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kPosedGrain = 256;
constexpr std::size_t kTasksAtOnce = 32;  // about half a millisecond of grouping

/// One ellipsoid near a sample.
struct NearSurface {
  std::uint32_t ellipsoid = 0;
  double distance_m = 0.0, score_m = 0.0;  ///< d, and d + kappa b
  proxy::TableReading reading;
};

struct FoundTerm {
  std::uint32_t ellipsoid = 0;
  ReliefTerm term;
};

/// Finds the terms of single samples; each task has its own.
class TermFinder {
 public:
  explicit TermFinder(const RefitInput& input)
      : input_(input), reach_(proxy::relief_reach(input.rest.stature_m() * input.scale)) {
    bounds_.resize(input.shapes.size());
  }

  /// Appends the terms of a sample and returns its target.
  double find(const ReliefSample& sample, std::uint32_t index, std::vector<FoundTerm>& found) {
    find_near(sample.point);
    const double least = least_m_;
    if (least < -reach_.in_m && sample.signed_distance_m < -0.5 * reach_.in_m) near_.clear();
    double sum = 0.0;
    for (const NearSurface& n : near_) sum += weight(n);
    double target_m = -sample.signed_distance_m;
    for (const NearSurface& n : near_) {
      const double share = weight(n) / sum;
      if (!(share > 0.0)) continue;
      const double clamped = std::clamp(n.distance_m, -reach_.in_m, reach_.out_m);
      // Eq. (1): s h + a (s clamp(d) - growth) / out, as share s (h + factor a).
      const double factor = (clamped - n.reading.growth_m / n.reading.scale * input_.scale) / reach_.out_m;
      target_m += share * (n.distance_m - n.reading.growth_m);
      found.push_back({n.ellipsoid,
                       {index, static_cast<float>(share * n.reading.scale), static_cast<float>(factor),
                        n.reading.direction.cast<float>()}});
    }
    return target_m;
  }

 private:
  double weight(const NearSurface& n) const {
    const double ramp = std::max(0.0, 1.0 - (n.score_m - least_m_) / reach_.blend_m);
    return ramp * ramp;
  }

  void add(std::size_t k, const Vec3& point) {
    const geometry::Ellipsoid& e = input_.shapes[k];
    const geometry::ClosestPoint closest = geometry::closest_point(e, point);
    if (closest.signed_distance > least_m_ + reach_.blend_m) return;
    const Vec3 w = (e.axes.transpose() * (closest.point - e.center)).cwiseQuotient(e.radii).normalized();
    NearSurface near{static_cast<std::uint32_t>(k), closest.signed_distance, 0.0,
                     input_.tables.read(static_cast<std::uint32_t>(k), w)};
    near.score_m = near.distance_m + near.reading.burial_m;
    least_m_ = std::min(least_m_, near.score_m);
    near_.push_back(near);
  }

  /// The ellipsoids that may be blended at a point.
  void find_near(const Vec3& point) {
    near_.clear();
    least_m_ = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < bounds_.size(); ++k) bounds_[k] = bound(input_.shapes[k], point);
    // The ellipsoid of the least bound comes first, because few others then have a bound below its score.
    const auto first = static_cast<std::size_t>(std::ranges::min_element(bounds_) - bounds_.begin());
    add(first, point);
    for (std::size_t k = 0; k < bounds_.size(); ++k)
      if (k != first && bounds_[k] <= least_m_ + reach_.blend_m) add(k, point);
  }

  /// A lower bound of the signed distance: by the enclosing sphere and by the support plane with the normal
  /// y / r.
  static double bound(const geometry::Ellipsoid& e, const Vec3& point) {
    const Vec3 to = point - e.center;
    const double ball = to.norm() - e.radii.maxCoeff();
    if (ball > 0.1) return ball;
    const Vec3 y = (e.axes.transpose() * to).cwiseQuotient(e.radii);
    const double level = y.squaredNorm();
    if (level <= 1.0) return ball;
    return std::max(ball, (level - std::sqrt(level)) / y.cwiseQuotient(e.radii).norm());
  }

  const RefitInput& input_;
  proxy::ReliefReach reach_;
  std::vector<double> bounds_;  // #E
  std::vector<NearSurface> near_;
  double least_m_ = 0.0;
};

/// Groups the terms of all tasks by ellipsoid; tasks and samples keep their order. Frames come first now and
/// then.
void group(const engine::Context& context, std::span<const std::vector<FoundTerm>> tasks,
           std::size_t ellipsoids, ReliefTerms& terms) {
  const std::size_t samples = terms.target_m.size();
  terms.begin.assign(ellipsoids + 1, 0);
  terms.of_begin.assign(samples + 1, 0);
  for (const auto& task : tasks)
    for (const FoundTerm& f : task) {
      ++terms.begin[f.ellipsoid + 1];
      ++terms.of_begin[f.term.sample + 1];
    }
  context.checkpoint();
  for (std::size_t k = 0; k < ellipsoids; ++k) terms.begin[k + 1] += terms.begin[k];
  for (std::size_t i = 0; i < samples; ++i) terms.of_begin[i + 1] += terms.of_begin[i];
  terms.term.resize(terms.begin.back());
  std::vector<std::size_t> next(terms.begin.begin(), terms.begin.end() - 1);
  std::size_t done = 0;
  for (const auto& task : tasks) {
    if (done++ % kTasksAtOnce == 0) context.checkpoint();
    for (const FoundTerm& f : task) {
      terms.of.push_back(static_cast<std::uint32_t>(next[f.ellipsoid]));
      terms.term[next[f.ellipsoid]++] = f.term;
    }
  }
}

}  // namespace

ReliefTerms find_posed_terms(const engine::Context& context, std::span<const ReliefSample> samples,
                             const RefitInput& input) {
  std::vector<std::vector<FoundTerm>> tasks(engine::block_count(samples.size(), kPosedGrain));
  ReliefTerms terms;
  terms.target_m.resize(samples.size());
  engine::parallel_for(context, samples.size(), kPosedGrain, [&](std::size_t begin, std::size_t end) {
    TermFinder finder(input);
    for (std::size_t i = begin; i < end; ++i)
      terms.target_m[i] = finder.find(samples[i], static_cast<std::uint32_t>(i), tasks[begin / kPosedGrain]);
  });
  for (const ReliefSample& sample : samples) {
    terms.weight.push_back(sample.weight);
    terms.signed_distance_m.push_back(sample.signed_distance_m);
  }
  context.checkpoint();
  group(context, tasks, input.shapes.size(), terms);
  return terms;
}

}  // namespace bodice::fitting
