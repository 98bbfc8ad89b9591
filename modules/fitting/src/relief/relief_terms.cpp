#include "relief/relief_terms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kBlock = 10;         // neighboring samples that share their candidates
constexpr std::size_t kReliefGrain = 512;  // samples a task

/// The terms of one task's samples, in the order of the samples.
struct Batch {
  struct Found {
    std::uint32_t ellipsoid;
    ReliefTerm term;
  };
  std::vector<Found> found;
};

/// A lower bound of the signed distance from `point` to the ellipsoid. It is |x - c| - r_max or, where that
/// is at most `enough`, the larger one of it and the distance to the support plane with the normal y / r,
/// beyond which the ellipsoid lies by convexity.
double lower_bound(const geometry::Ellipsoid& e, const Vec3& point, double enough) {
  const Vec3 to = point - e.center;
  const double ball = to.norm() - e.radii.maxCoeff();
  if (ball > enough) return ball;
  const Vec3 y = (e.axes.transpose() * to).cwiseQuotient(e.radii);
  const double level = y.squaredNorm();
  if (level <= 1.0) return ball;
  return std::max(ball, (level - std::sqrt(level)) / y.cwiseQuotient(e.radii).norm());
}

/// An ellipsoid with its distance to a ball's center.
struct Candidate {
  double bound;
  std::uint32_t ellipsoid;
};

/// The ellipsoids that can be at most `blend_m` farther than the nearest one somewhere in a ball, nearest
/// first.
std::vector<Candidate> candidates_in(std::span<const proxy::ProxyEllipsoid> ellipsoids, const Vec3& center,
                                     double radius_m, double blend_m) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<Candidate> found;
  for (std::uint32_t k = 0; k < ellipsoids.size(); ++k) {
    const double enough = least + 2.0 * radius_m + blend_m;
    const double bound = lower_bound(ellipsoids[k].shape, center, enough);
    if (bound > enough) continue;
    const double d = geometry::closest_point(ellipsoids[k].shape, center).signed_distance;
    least = std::min(least, d);
    found.push_back({d, k});
  }
  std::erase_if(found, [&](const Candidate& c) { return c.bound > least + 2.0 * radius_m + blend_m; });
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.bound != b.bound ? a.bound < b.bound : a.ellipsoid < b.ellipsoid;
  });
  return found;
}

/// An ellipsoid near a sample.
struct NearTable {
  geometry::ClosestPoint closest;
  std::uint32_t ellipsoid;
};

/// Finds the terms of blocks of neighboring samples, which share their candidates.
class TermSearch {
 public:
  /// Both must outlive this object.
  TermSearch(std::span<const proxy::ProxyEllipsoid> ellipsoids, const proxy::ReliefReach& reach)
      : ellipsoids_(ellipsoids), reach_(reach) {}

  /// Adds the terms of a block, the first sample of which has the index `first`, and writes the sums that
  /// they should have.
  void find(std::span<const ReliefSample> block, std::size_t first, Batch& batch, std::span<double> target_m);

 private:
  double find_sample(const ReliefSample& sample, std::uint32_t index, Batch& batch);

  std::span<const proxy::ProxyEllipsoid> ellipsoids_;
  const proxy::ReliefReach& reach_;
  std::vector<Candidate> candidates_;  ///< of the current block
  std::vector<NearTable> near_;        ///< to the current sample
};

/// Adds the terms of one sample, and returns the sum that they should have.
double TermSearch::find_sample(const ReliefSample& sample, std::uint32_t index, Batch& batch) {
  near_.clear();
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates_) {
    const geometry::Ellipsoid& e = ellipsoids_[c.ellipsoid].shape;
    const double enough = least + reach_.blend_m;
    if (lower_bound(e, sample.point, enough) > enough) continue;
    near_.push_back({geometry::closest_point(e, sample.point), c.ellipsoid});
    least = std::min(least, near_.back().closest.signed_distance);
  }
  const bool deep = least < -reach_.in_m && sample.signed_distance_m < -0.5 * reach_.in_m;
  if (deep)
    near_.clear();  // the proxy and the skin agree that it is deep inside: there is nothing to correct
  const auto weight = [&](const NearTable& n) {
    const double ramp = std::max(0.0, 1.0 - (n.closest.signed_distance - least) / reach_.blend_m);
    return ramp * ramp;
  };
  double sum = 0.0;
  for (const NearTable& n : near_) sum += weight(n);
  double target_m = -sample.signed_distance_m;
  for (const NearTable& n : near_) {
    const double share = weight(n) / sum, d = n.closest.signed_distance;
    if (!(share > 0.0)) continue;
    const geometry::Ellipsoid& e = ellipsoids_[n.ellipsoid].shape;
    const Vec3 w = (e.axes.transpose() * (n.closest.point - e.center)).cwiseQuotient(e.radii).normalized();
    const double factor = std::clamp(d, -reach_.in_m, reach_.out_m) / reach_.out_m;
    target_m += share * d;
    batch.found.push_back(
        {n.ellipsoid, {index, static_cast<float>(share), static_cast<float>(factor), w.cast<float>()}});
  }
  return target_m;
}

void TermSearch::find(std::span<const ReliefSample> block, std::size_t first, Batch& batch,
                      std::span<double> target_m) {
  geometry::Box box;
  for (const ReliefSample& s : block) box.extend(s.point);
  candidates_ = candidates_in(ellipsoids_, box.center(), 0.5 * box.size().norm(), reach_.blend_m);
  for (std::size_t i = 0; i < block.size(); ++i)
    target_m[i] = find_sample(block[i], static_cast<std::uint32_t>(first + i), batch);
}

/// Groups the terms of all tasks by ellipsoid.
void group(std::span<const Batch> batches, std::size_t samples, std::size_t ellipsoids, ReliefTerms& result) {
  result.begin.assign(ellipsoids + 1, 0);
  result.of_begin.assign(samples + 1, 0);
  for (const Batch& batch : batches)
    for (const Batch::Found& f : batch.found) {
      ++result.begin[f.ellipsoid + 1];
      ++result.of_begin[f.term.sample + 1];
    }
  for (std::size_t k = 0; k < ellipsoids; ++k) result.begin[k + 1] += result.begin[k];
  for (std::size_t i = 0; i < samples; ++i) result.of_begin[i + 1] += result.of_begin[i];
  result.term.resize(result.begin.back());
  result.of.resize(result.term.size());
  std::vector<std::size_t> next(result.begin.begin(), result.begin.end() - 1);
  std::size_t position = 0;
  for (const Batch& batch : batches)
    for (const Batch::Found& f : batch.found) {
      const std::size_t at = next[f.ellipsoid]++;
      result.term[at] = f.term;
      result.of[position++] = static_cast<std::uint32_t>(at);  // batches hold their samples in order
    }
}

}  // namespace

ReliefTerms find_terms(const engine::Context& context, std::span<const ReliefSample> samples,
                       std::span<const proxy::ProxyEllipsoid> ellipsoids, const proxy::ReliefReach& reach) {
  std::vector<Batch> batches(engine::block_count(samples.size(), kReliefGrain));
  ReliefTerms result;
  result.target_m.resize(samples.size());
  result.weight.resize(samples.size());
  result.signed_distance_m.resize(samples.size());
  const std::span<double> target(result.target_m);
  engine::parallel_for(context, samples.size(), kReliefGrain, [&](std::size_t begin, std::size_t end) {
    TermSearch search(ellipsoids, reach);
    for (std::size_t i = begin; i < end; i += kBlock) {
      const std::size_t count = std::min(kBlock, end - i);
      search.find(samples.subspan(i, count), i, batches[begin / kReliefGrain], target.subspan(i, count));
    }
    for (std::size_t i = begin; i < end; ++i) {
      result.weight[i] = samples[i].weight;
      result.signed_distance_m[i] = samples[i].signed_distance_m;
    }
  });
  group(batches, samples.size(), ellipsoids.size(), result);
  return result;
}

ReliefTerms joined(const ReliefTerms& terms, const ReliefTerms& more) {
  const auto samples = static_cast<std::uint32_t>(terms.target_m.size());
  ReliefTerms all = terms;
  all.term.clear();
  std::vector<std::uint32_t> index(terms.term.size()), index_of_more(more.term.size());  // into all.term
  for (std::size_t k = 0; k + 1 < terms.begin.size(); ++k) {
    all.begin[k] = all.term.size();
    for (std::size_t m = terms.begin[k]; m < terms.begin[k + 1]; ++m) {
      index[m] = static_cast<std::uint32_t>(all.term.size());
      all.term.push_back(terms.term[m]);
    }
    for (std::size_t m = more.begin[k]; m < more.begin[k + 1]; ++m) {
      index_of_more[m] = static_cast<std::uint32_t>(all.term.size());
      all.term.push_back(more.term[m]);
      all.term.back().sample += samples;
    }
  }
  all.begin.back() = all.term.size();
  for (std::uint32_t& position : all.of) position = index[position];
  for (const std::uint32_t position : more.of) all.of.push_back(index_of_more[position]);
  for (std::size_t i = 1; i < more.of_begin.size(); ++i)
    all.of_begin.push_back(terms.of.size() + more.of_begin[i]);
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(all.target_m, more.target_m);
  add(all.signed_distance_m, more.signed_distance_m);
  add(all.weight, more.weight);
  return all;
}

}  // namespace bodice::fitting
