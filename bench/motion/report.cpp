#include "report.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>

#include <nlohmann/json.hpp>

#include <bench_support/origin.hpp>

#include "line_plot.hpp"

namespace bench {
namespace {

using nlohmann::json;

constexpr double kMega = 1e6;

json to_json(const Spread_mm& s) {
  return {{"mean_mm", s.mean}, {"p95_mm", s.p95}, {"max_mm", s.max}};
}

json to_json(const MethodResult& m) {
  json frames = json::array();
  for (std::size_t i = 0; i < m.time_s.size(); ++i) {
    json frame = to_json(m.judge.of_frame()[i]);
    frame["time_s"] = m.time_s[i];
    frames.push_back(std::move(frame));
  }
  const auto& worst = m.judge.worst_point();
  return {{"method", m.name},
          {"error", to_json(m.judge.error())},
          {"missed_percent", m.judge.missed_percent()},
          {"false_percent", m.judge.false_percent()},
          {"coverage_percent", m.knows_depth ? json(m.judge.coverage_percent()) : json()},
          {"protrusion", to_json(m.judge.protrusion())},
          {"surface_gap", to_json(m.judge.gap())},
          {"points", m.judge.points()},
          {"worst",
           {{"time_s", m.time_s[m.judge.worst_frame()]}, {"position_m", {worst.x(), worst.y(), worst.z()}}}},
          {"pose_ms", m.cost.pose_ms},
          {"query_ns", m.cost.query_ns},
          {"bytes", m.bytes},
          {"frames", std::move(frames)}};
}

json to_json(const MotionResult& r) {
  json methods = json::array();
  for (const MethodResult& m : r.methods) methods.push_back(to_json(m));
  return {{"body", r.body},
          {"motion", r.motion},
          {"methods", std::move(methods)},
          {"refit_ms", r.refit_ms},
          {"ellipsoids_ms", r.cost.ellipsoids_ms},
          {"tables_ms", r.cost.tables_ms},
          {"skirt_ms", r.cost.skirt_ms},
          {"collider_ms", r.cost.collider_ms},
          {"exact_over_static", r.cost.exact_over_static},
          {"first_order_over_static", r.cost.first_order_over_static},
          {"bind_pose_over_static", r.cost.bind_pose_over_static}};
}

/// A row of the table of bars.
void print_bar(const char* what, double value, double bar, double stretch, const std::string& where) {
  std::printf("| %-52s | %8.2f | %7.2f | %7.2f | %s%s |\n", what, value, bar, stretch, where.c_str(),
              value <= bar ? "" : "  MISSED");
}

/// The largest of a number over the motions of a kind, and where it is.
class Worst {
 public:
  template <class Number>
  Worst(const std::vector<MotionResult>& motions, std::initializer_list<const char*> kinds,
        const Number& number) {
    for (const MotionResult& r : motions) {
      const bool counts = kinds.size() == 0 || std::ranges::any_of(kinds, [&](const char* kind) {
                            return r.motion.starts_with(kind);
                          });
      if (!counts || (any && !(number(r) > value))) continue;
      value = number(r), where = r.body + " " + r.motion, any = true;
    }
  }
  double value = 0.0;
  std::string where;
  bool any = false;

  void print(const char* what, double bar, double stretch) const {
    if (any) print_bar(what, value, bar, stretch, where);
  }
};

Spread_mm worst_frame(const Judge& judge) {
  Spread_mm worst;
  for (const Spread_mm& frame : judge.of_frame())
    if (frame.mean > worst.mean) worst = frame;
  return worst;
}

void print_accuracy(const std::vector<MotionResult>& motions) {
  const auto carried = [](const MotionResult& r) -> const Judge& { return r.methods[0].judge; };
  const auto mean = [&](const MotionResult& r) { return carried(r).error().mean; };
  const auto p95 = [&](const MotionResult& r) { return carried(r).error().p95; };
  Worst(motions, {"walk", "reach", "clip"}, mean).print("walk, reach, carried: mean, mm", 0.6, 0.45);
  Worst(motions, {"walk", "reach", "clip"}, p95).print("walk, reach, carried: 95 %, mm", 2.1, 1.6);
  Worst(motions, {"run", "dance"}, mean).print("run, dance, carried: mean, mm", 0.8, 0.5);
  Worst(motions, {"run", "dance"}, p95).print("run, dance, carried: 95 %, mm", 2.8, 1.8);
  const auto kPoses = {"sit", "squat", "arms-up"};
  Worst(motions, kPoses, [&](const MotionResult& r) {
    return worst_frame(carried(r)).mean;
  }).print("sit, squat, arms up, worst frame, carried: mean, mm", 1.1, 0.6);
  Worst(motions, kPoses, [&](const MotionResult& r) {
    return worst_frame(carried(r)).p95;
  }).print("sit, squat, arms up, worst frame, carried: 95 %, mm", 4.5, 2.2);
  Worst(motions, kPoses, [](const MotionResult& r) {
    return worst_frame(r.methods[1].judge).mean;
  }).print("the same, refit: mean, mm", 0.4, 0.35);
  Worst(motions, kPoses, [](const MotionResult& r) {
    return worst_frame(r.methods[1].judge).p95;
  }).print("the same, refit: 95 %, mm", 1.6, 1.2);
  Worst(motions, {}, [](const MotionResult& r) { return r.refit_ms; }).print("a refit, ms", 500.0, 500.0);
  Worst(motions, {}, [&](const MotionResult& r) {
    return carried(r).missed_percent();
  }).print("missed, %", 0.3, 0.1);
  Worst(motions, {}, [&](const MotionResult& r) {
    return carried(r).false_percent();
  }).print("false, %", 0.5, 0.2);
  Worst(motions, {}, [&](const MotionResult& r) {
    return carried(r).error().max;
  }).print("worst point of any frame, mm", 15.0, 8.0);
}

void print_costs(const std::vector<BodyResult>& bodies, const std::vector<MotionResult>& motions) {
  Worst(motions, {}, [](const MotionResult& r) {
    return r.cost.ellipsoids_ms;
  }).print("posing ellipsoids alone, ms", 0.08, 0.04);
  Worst(motions, {}, [](const MotionResult& r) {
    return r.cost.tables_ms;
  }).print("posing with tables, whole body, ms", 1.0, 0.4);
  Worst(motions, {}, [](const MotionResult& r) {
    return r.cost.skirt_ms;
  }).print("posing what one skirt can reach, ms", 0.4, 0.2);
  Worst(motions, {}, [](const MotionResult& r) {
    return r.cost.bind_pose_over_static;
  }).print("query, bind pose over static", 1.25, 1.1);
  Worst(motions, {}, [](const MotionResult& r) {
    return r.cost.exact_over_static;
  }).print("query, posed over static", 1.25, 1.1);
  Worst(motions, {}, [](const MotionResult& r) {
    return r.cost.first_order_over_static;
  }).print("query to first order, posed over static", 1.25, 1.1);
  for (const BodyResult& b : bodies) {
    print_bar("binding, on top of the fit, s", 1e-3 * b.bind_ms, 0.5, 0.2, b.body);
    print_bar("memory of the bound proxy, MB", (b.proxy_bytes + b.binding_bytes) / kMega, 1.0, 0.4, b.body);
  }
}

}  // namespace

void print_motion(const MotionResult& r) {
  std::printf("\n%s, %s (%zu points)\n", r.body.c_str(), r.motion.c_str(), r.methods[0].judge.points());
  std::printf("%-36s %17s %13s %6s %19s %19s %8s %8s %8s\n", "", "error mm", "missed, false", "cover-",
              "protrusion mm", "surface gap mm", "pose", "query", "");
  std::printf("%-36s %17s %13s %6s %19s %19s %8s %8s %8s\n", "method", "mean / 95 / max", "%", "age %",
              "mean / 95 / max", "mean / 95 / max", "ms", "ns", "MB");
  for (const MethodResult& m : r.methods) {
    const Spread_mm e = m.judge.error(), over = m.judge.protrusion(), under = m.judge.gap();
    std::printf("%-36s %5.2f %5.2f %5.1f %6.2f %6.2f", m.name.c_str(), e.mean, e.p95, e.max,
                m.judge.missed_percent(), m.judge.false_percent());
    if (m.knows_depth)
      std::printf(" %6.1f", m.judge.coverage_percent());
    else
      std::printf(" %6s", "-");
    std::printf(" %6.2f %6.2f %5.1f %6.2f %6.2f %5.1f %8.3f %8.1f", over.mean, over.p95, over.max, under.mean,
                under.p95, under.max, m.cost.pose_ms, m.cost.query_ns);
    if (m.bytes > 0.0) std::printf(" %8.3f", m.bytes / kMega);
    std::puts("");
  }
  std::fflush(stdout);
}

void print_bars(const std::vector<BodyResult>& bodies, const std::vector<MotionResult>& motions) {
  std::printf("\n%s; one thread, processor time\n\n", title(find_origin()).c_str());
  std::printf("| %-52s | %8s | %7s | %7s | where |\n|---|---|---|---|---|\n",
              "worst of all bodies and motions", "measured", "at most", "stretch");
  print_accuracy(motions);
  print_costs(bodies, motions);
}

bool write_json(const std::vector<BodyResult>& bodies, const std::vector<MotionResult>& motions,
                const std::filesystem::path& file) {
  json all = {{"origin", title(find_origin())}, {"bodies", json::array()}, {"motions", json::array()}};
  for (const BodyResult& b : bodies)
    all["bodies"].push_back({{"body", b.body},
                             {"vertices", b.vertices},
                             {"ellipsoids", b.ellipsoids},
                             {"bind_ms", b.bind_ms},
                             {"proxy_bytes", b.proxy_bytes},
                             {"binding_bytes", b.binding_bytes}});
  for (const MotionResult& r : motions) all["motions"].push_back(to_json(r));
  std::ofstream out(file);
  out << all.dump(1) << '\n';
  return out.good();
}

bool write_plot(const std::vector<MotionResult>& motions, const std::filesystem::path& png) {
  std::vector<LinePanel> panels;
  for (const MotionResult& r : motions) {
    LinePanel panel{r.body + ", " + r.motion, {}};
    for (const MethodResult& m : r.methods) {
      Line line{m.name, m.time_s, {}};
      for (const Spread_mm& frame : m.judge.of_frame()) line.y.push_back(frame.mean);
      panel.lines.push_back(std::move(line));
    }
    panels.push_back(std::move(panel));
  }
  return write_line_plot(panels, "mean error within 30 mm of the skin, mm, over seconds", png);
}

}  // namespace bench
