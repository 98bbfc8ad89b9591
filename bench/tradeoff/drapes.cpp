// The time of a frame of cloth and its depth inside the true skin, by tier, response and substeps.
#include <bodice/tryon/drape.hpp>

#include <algorithm>
#include <map>

#include "must.hpp"
#include "sweep.hpp"
#include "worn.hpp"

namespace tradeoff {
namespace {

using namespace bodice;
using collision::Response;
using proxy::Tier;

/// How a garment is draped.
struct Choice {
  Tier tier;
  Response response;
  int substeps;
};

std::vector<Choice> choices(const Setting& setting) {
  if (setting.effort == Effort::kSmallest) return {{Tier::kSolid, Response::kClosestPoint, 4}};
  std::vector<Choice> all;
  for (const Tier tier : {Tier::kPaper, Tier::kSolid, Tier::kTight, Tier::kRelief})
    for (const Response response : {Response::kPaper, Response::kClosestPoint}) {
      // The paper's tier leaks; it is draped with the paper's response alone.
      if (tier == Tier::kPaper && response == Response::kClosestPoint) continue;
      // The paper's response takes many times as long, so that two rows have to suffice.
      const bool few = setting.effort == Effort::kQuick || response == Response::kPaper;
      const auto counts = few ? std::vector{4, 16} : std::vector{4, 8, 16, 32};
      for (const int substeps : counts) all.push_back({tier, response, substeps});
    }
  return all;
}

const char* name(Response response) {
  return response == Response::kPaper ? "paper" : "nearest";
}

/// The proxies of all tiers, each fitted once.
class Fits {
 public:
  Fits(const Setting& setting, const Subject& subject) : setting_(setting), subject_(subject) {}

  const tryon::PreparedBody& operator[](Tier tier) {
    const auto known = bodies_.find(tier);
    if (known != bodies_.end()) return known->second;
    progress("drapes", subject_.name + ", " + std::string(proxy::name(tier)));
    const fitting::FitOptions options{.tier = tier, .max_ellipsoids = setting_.by_effort(30, 55, 89)};
    return bodies_.emplace(tier, must(tryon::fit_proxy(setting_.context, subject_.skin, options)))
        .first->second;
  }

 private:
  const Setting& setting_;
  const Subject& subject_;
  std::map<Tier, tryon::PreparedBody> bodies_;
};

tryon::DrapeReport drape(const Setting& setting, const tryon::PreparedBody& body,
                         const tryon::WornGarment& garment, const Choice& choice) {
  tryon::DrapeOptions options;
  options.frames = setting.by_effort(3, 20, 60);
  options.solver.substeps = choice.substeps;
  options.solver.response = choice.response;
  options.solver.environment.wind_m_s = {0.0, 0.0, 2.0};
  options.solver.environment.gust = 0.3;
  return must(tryon::drape(setting.context, body, {garment}, options)).report;
}

void add_garment(const Setting& setting, const Subject& subject, const GarmentChoice& kind, Fits& fits,
                 bench::Table& table, std::map<std::string, bench::PlotSeries>& series) {
  constexpr double kLeastDrawn_mm = 0.01;
  const auto garment = cut_for(setting.context, subject, kind, setting.by_effort(0.03, 0.02, 0.015));
  for (const Choice& choice : choices(setting)) {
    const std::string tier(proxy::name(choice.tier));
    progress("drapes", subject.name + ", " + kind.name + ", " + tier + ", " + name(choice.response) + ", " +
                           std::to_string(choice.substeps) + " substeps");
    const tryon::DrapeReport r = drape(setting, fits[choice.tier], garment, choice);
    table.add({subject.name, kind.name, tier, name(choice.response), choice.substeps, r.particles,
               1e3 * r.penetration_max_m, 1e3 * r.penetration_end_m, r.penetration_over_1mm,
               100.0 * r.pierced_share, 100.0 * r.stretch_p95, 1e3 * r.median_speed_m_s, r.inside_union,
               r.frame_ms_median, r.frame_ms_p99});
    bench::PlotSeries& line = series[tier + ", " + name(choice.response)];
    if (&kind != kGarments) continue;  // the plot shows the first garment
    line.points.push_back({r.frame_ms_median, std::max(kLeastDrawn_mm, 1e3 * r.penetration_max_m),
                           std::to_string(choice.substeps)});
  }
}

}  // namespace

Findings sweep_drapes(const Setting& setting) {
  bench::Table table(
      "drapes",
      "Cotton in gusty wind of 2 m/s; depths in the exact signed distance to the skin, the "
      "deepest particle of any frame and of the last; pierced is the share of the cloth's area.",
      {"body", "garment", "tier", "response", "substeps", "particles", "deepest_mm", "end_mm", "over_1mm",
       "pierced_%", "stretch_p95_%", "speed_end_mm/s", "inside_proxy", "frame_ms", "p99_ms"});
  std::map<std::string, bench::PlotSeries> series;
  for (const SubjectSource& source : made_bodies(0, 1, setting.vertices())) {
    const Subject subject = source.make(setting.context);
    Fits fits(setting, subject);
    const int garments = setting.by_effort(1, 1, 2);
    for (int g = 0; g < garments; ++g) add_garment(setting, subject, kGarments[g], fits, table, series);
  }
  Findings found;
  found.text =
      "Frames of 1/60 s, two sweeps a substep, thickness as `bodice drape` chooses it. A garment that ends "
      "faster than a meter a second was thrown off the body, so that its depth has no meaning.\n";
  found.shown.push_back(std::move(table));
  bench::Plot plot{"Depth in the true skin against the time of a frame (skirt; labels: substeps)",
                   "median frame, ms",
                   "deepest particle of any frame, mm (0.01: none)",
                   "",
                   {}};
  std::map<std::string, int> colors;  // each tier has a color; marks are hollow for the paper's response
  for (auto& [label, line] : series) {
    line.name = label, line.hollow = label.ends_with(", paper");
    line.color =
        colors.try_emplace(label.substr(0, label.find(',')), static_cast<int>(colors.size())).first->second;
    plot.series.push_back(line);
  }
  found.plots.emplace_back("drapes", std::move(plot));
  return found;
}

}  // namespace tradeoff
