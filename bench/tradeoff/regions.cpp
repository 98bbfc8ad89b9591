// Proxies of only what a garment can reach: what they save, and whether their distances are those of the
// whole body.
#include <algorithm>
#include <cmath>

#include <bench_support/stopwatch.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/tryon/reach.hpp>

#include "contender.hpp"
#include "must.hpp"
#include "sweep.hpp"
#include "worn.hpp"

namespace tradeoff {
namespace {

using namespace bodice;
using proxy::Tier;

constexpr double kMargin_m = 0.05;  // the default of `bodice fit --region-of`

/// Points near the garment: each vertex, moved in a random direction.
bench::Cloud around(const geometry::TriMesh& garment, double within_m) {
  engine::Random random(31);
  bench::Cloud cloud;
  for (const geometry::Vec3& p : garment.positions) {
    const double a = random.normal(), b = random.normal(), c = random.normal();
    cloud.add(p + within_m * random.uniform() * geometry::Vec3(a, b, c).stableNormalized());
  }
  return bench::coherent(cloud);
}

/// Nanoseconds a particle of a query without a workspace.
double query_ns(const proxy::BodyProxy& proxy, const bench::Cloud& cloud) {
  const collision::Collider collider(proxy);
  bench::Cloud local = bench::local(cloud, collider);
  std::vector<collision::Contact> contacts(cloud.size());
  const double us = least_us([&] { collider.query({}, local.particles(), contacts); }, 3);
  return 1e3 * us / static_cast<double>(cloud.size());
}

/// The difference of distances that matter to a garment: at points closer to the body than half of the
/// margin.
struct Agreement {
  std::size_t points = 0, same_bits = 0;
  double largest_mm = 0.0, mean_mm = 0.0;
  double error_mm = 0.0;  ///< mean, against the exact signed distance

  double same_percent() const {
    return points == 0 ? 0.0 : 100.0 * static_cast<double>(same_bits) / static_cast<double>(points);
  }
};

Agreement compare(const Subject& subject, const proxy::BodyProxy& whole, const proxy::BodyProxy& region,
                  const bench::Cloud& cloud) {
  Agreement agreement;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double a = proxy::proxy_distance(whole, cloud.at(i)).distance;
    if (a > 0.5 * kMargin_m) continue;
    const double b = proxy::proxy_distance(region, cloud.at(i)).distance;
    ++agreement.points;
    agreement.same_bits += a == b;
    agreement.largest_mm = std::max(agreement.largest_mm, 1e3 * std::abs(a - b));
    agreement.mean_mm += 1e3 * std::abs(a - b);
    agreement.error_mm += 1e3 * std::abs(b - subject.skin.distance->signed_distance(cloud.at(i)));
  }
  const auto points = static_cast<double>(std::max<std::size_t>(1, agreement.points));
  agreement.mean_mm /= points, agreement.error_mm /= points;
  return agreement;
}

/// A fit with its time.
struct Fitted {
  fitting::FitResult fit;
  double ms = 0.0;
};

Fitted fit_parts(const Setting& setting, const Subject& subject, Tier tier, std::uint32_t parts) {
  auto fit =
      must(fitting::fit(setting.context, tryon::labeled(subject.skin),
                        {.tier = tier, .max_ellipsoids = setting.by_effort(30, 55, 89), .parts = parts}));
  const double ms = fit_ms(fit);
  return {std::move(fit), ms};
}

/// A proxy for the garment.
struct Variant {
  const char* name;
  proxy::BodyProxy proxy;
  double prepare_ms;
};

void add_row(const Subject& subject, const tryon::WornGarment& garment, const proxy::BodyProxy& whole,
             const Variant& v, const bench::Cloud& cloud, bench::Table& table) {
  const Agreement agree = compare(subject, whole, v.proxy, cloud);
  table.add({subject.name, garment.name, proxy::name(whole.tier()), v.name, v.proxy.ellipsoids().size(),
             1e-3 * static_cast<double>(v.proxy.bytes()), agree.points, agree.same_percent(), agree.mean_mm,
             agree.largest_mm, agree.error_mm, v.prepare_ms, query_ns(v.proxy, cloud)});
}

void add_tier(const Setting& setting, const Subject& subject, const tryon::WornGarment& garment, Tier tier,
              bench::Table& table) {
  progress("regions", subject.name + ", " + garment.name + ", " + std::string(proxy::name(tier)));
  const std::span<const geometry::TriMesh> mesh(&garment.mesh, 1);
  const bench::Stopwatch watch;
  const std::uint32_t parts = tryon::reachable_parts(setting.context, subject.skin, mesh, kMargin_m).value();
  const double reach_ms = watch.wall_ms();
  const Fitted whole = fit_parts(setting, subject, tier, fitting::kAllParts);
  const Fitted region = fit_parts(setting, subject, tier, parts);
  const double parts_ms = region.ms + reach_ms;
  const bench::Cloud cloud = around(garment.mesh, 0.5 * kMargin_m);
  const auto add = [&](const char* name, const proxy::BodyProxy& proxy, double prepare_ms) {
    add_row(subject, garment, whole.fit.proxy, {name, proxy, prepare_ms}, cloud, table);
  };
  const auto add_cropped = [&](const char* name, const proxy::BodyProxy& from, double fitted_ms) {
    const bench::Stopwatch crop;
    const proxy::BodyProxy near = must(tryon::within_reach(setting.context, from, mesh, kMargin_m));
    add(name, near, fitted_ms + crop.wall_ms());
  };
  add("whole", whole.fit.proxy, whole.ms);
  add_cropped("whole cropped", whole.fit.proxy, whole.ms);
  add("parts", region.fit.proxy, parts_ms);
  add_cropped("parts cropped", region.fit.proxy, parts_ms);
}

}  // namespace

Findings sweep_regions(const Setting& setting) {
  bench::Table table(
      "regions",
      "The whole body, and the parts within 50 mm of the garment; cropped: only the ellipsoids within 50 mm. "
      "Distances against those of the whole body (apart) and the exact ones (error), at points within 25 mm "
      "of "
      "garment and body.",
      {"body", "garment", "tier", "fitted", "ellipsoids", "KB", "points", "same_bits_%", "mean_apart_mm",
       "most_apart_mm", "mean_error_mm", "prepare_ms", "query_ns"});
  const std::vector<Tier> tiers = setting.effort == Effort::kSmallest
                                      ? std::vector{Tier::kSolid}
                                      : std::vector{Tier::kPaper, Tier::kSolid, Tier::kTight, Tier::kRelief};
  for (const SubjectSource& source : made_bodies(0, setting.bodies(1, 1, 2), setting.vertices())) {
    const Subject subject = source.make(setting.context);
    for (int g = 0; g < setting.by_effort(1, 1, 2); ++g)
      for (const Tier tier : tiers)
        add_tier(setting, subject, cut_for(setting.context, subject, kGarments[g], 0.015), tier, table);
  }
  Findings found;
  found.text =
      "`bodice fit --region-of GARMENT` fits only the parts that the garment can reach, with the torso as "
      "one. Paper "
      "and solid fit a part alone as in the whole body, so that distances have the same bits. Tight and "
      "relief fit "
      "neighbors together, so that other neighbors give other ellipsoids: they are as close to the skin "
      "(error) as "
      "those of the whole body, but not the same (apart). `tryon::within_reach` crops a proxy to a garment "
      "without "
      "changing a distance. Distances are those of the reference in double.\n";
  found.shown.push_back(std::move(table));
  return found;
}

}  // namespace tradeoff
