// Cost of a query and of a response a particle, with its error, beside other methods that can answer the
// same. One thread, one run, CPU time; median and min of the repeats, interleaved so that a slow minute
// affects all rows alike.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <bench_support/help.hpp>
#include <bench_support/origin.hpp>

#include <bench_references/peers.hpp>
#include <bench_references/subject.hpp>
#include "counts.hpp"
#include "figures.hpp"
#include "frames.hpp"
#include "limits.hpp"
#include "peer_rows.hpp"
#include "rows.hpp"
#include "targets.hpp"

namespace {

using bench::error_of;
using bench::Frames;
using bench::kBand_m;
using bench::Row;
using bench::row_of;
using bodice::collision::Accuracy;
using bodice::collision::Collider;
using bodice::collision::Contact;
using bodice::collision::Workspace;
using bodice::proxy::Tier;

constexpr int kEllipsoids = 89;

/// One kind of query.
struct QueryKind {
  const char* name;
  bodice::collision::QueryOptions options;
  bool bar;  ///< whether the bar of kQueryKinds applies to it
};

constexpr float kShort_m = 0.010f;
constexpr float kAll_m = std::numeric_limits<float>::infinity();
/// The bar of 7.5 and 15 ns comes from a prototype of 'inside only' that used estimates. It gave closest
/// points of particles inside and nothing about others. The bar applies to the other kinds of query as well.
constexpr QueryKind kQueryKinds[] = {{"all distances", {.within_m = kAll_m}, true},
                                     {"contacts within 10 mm", {.within_m = kShort_m}, false},
                                     {"inside only", {.within_m = 0.0f}, true},
                                     {"to first order", {.accuracy = Accuracy::kFirstOrder}, true}};
/// Embree's distance has no sign. Whether a particle is inside, and how deep, follows only from the nearest
/// triangle, however far it is. With the short reach there is no result for particles deeper than it.
constexpr double kFarReach_m = kBand_m + 0.001, kShortReach_m = 0.010;
/// Without knowing how far the particles are, a search must go as far as needed, as a query of all distances
/// does.
constexpr double kAnyReach_m = std::numeric_limits<double>::infinity();
constexpr double kEmbreeReaches_m[] = {kAnyReach_m, kFarReach_m, kShortReach_m};

/// One proxy, its particles in both orders, and storage for the results.
struct Contender {
  std::string name;
  Collider collider, moving;
  std::vector<bodice::geometry::Ellipsoid> shapes;
  bench::Cloud coherent, moved;
  std::vector<Contact> contacts;
  bool relief;
  Frames frames[2], response_frames[2], beside_moving;  ///< coherent, random

  Contender(std::string label, const bodice::proxy::BodyProxy& proxy, const bench::Cloud& ordered,
            const bench::Cloud& shuffled)
      : name(std::move(label)),
        collider(proxy),
        moving(proxy),
        coherent(bench::local(ordered, collider)),
        moved(coherent),
        contacts(ordered.size()),
        relief(!proxy.relief().empty()),
        frames{Frames(coherent), Frames(bench::local(shuffled, collider))},
        response_frames{Frames(coherent), Frames(bench::local(shuffled, collider))},
        beside_moving(coherent) {
    for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  }

  /// Turns the proxy about the vertical and shifts it by a step, there or back.
  void move_rigidly(double angle_rad) {
    const bodice::geometry::Mat3 turn =
        Eigen::AngleAxisd(forth ? angle_rad : -angle_rad, bodice::geometry::Vec3::UnitY()).toRotationMatrix();
    forth = !forth;
    for (auto& e : shapes) {
      e.center = turn * e.center;
      e.axes = turn * e.axes;
    }
    moving.move_to(shapes, 1.0 / 60.0);
  }
  bool forth = true;

  std::vector<float> distances(Accuracy accuracy) {
    collider.query({}, coherent.particles(), contacts, {.accuracy = accuracy});
    std::vector<float> d;
    for (const Contact& c : contacts) d.push_back(c.signed_distance);
    return d;
  }
};

/// Names of the rows measured with a workspace.
constexpr const char* kFrames[] = {", coherent, frames", ", random, frames"};

void add_queries(Contender& c, std::vector<Row>& rows) {
  const auto n = static_cast<double>(c.coherent.size());
  for (const QueryKind& q : kQueryKinds) {
    const bodice::collision::QueryOptions options = q.options;
    const std::string name = c.name + ": query, " + q.name;
    const double bars[] = {c.relief ? 30.0 : 7.5, c.relief ? 60.0 : 15.0};
    rows.push_back({name + ", coherent, nothing kept",
                    [&c, options] { c.collider.query({}, c.coherent.particles(), c.contacts, options); }, n,
                    q.bar ? bars[0] : 0.0});
    for (int order = 0; order < 2; ++order) {
      Frames& frames = c.frames[order];
      rows.push_back({name + kFrames[order],
                      [&c, &frames, options] {
                        c.collider.query({}, frames.now().particles(), c.contacts, frames.workspace, options);
                      },
                      n, q.bar ? bars[order] : 0.0, [&frames] { frames.step(); }, bench::kFrameCalls});
    }
  }
}

/// A response moves the particles, so that each call gets its own copy, which is not timed.
void add_responses(Contender& c, std::vector<Row>& rows) {
  const auto n = static_cast<double>(c.coherent.size());
  const std::string name = c.name + ": response";
  rows.push_back({name + ", coherent, nothing kept",
                  [&c] { c.collider.resolve({}, c.moved.particles(), {}); }, n, 0.0,
                  [&c] { c.moved = c.coherent; }});
  for (int order = 0; order < 2; ++order) {
    Frames& frames = c.response_frames[order];
    rows.push_back({name + kFrames[order],
                    [&c, &frames] { c.collider.resolve({}, c.moved.particles(), {}, frames.workspace); }, n,
                    0.0,
                    [&c, &frames] {
                      frames.step();
                      c.moved = frames.now();
                    },
                    bench::kFrameCalls});
  }
}

void add_rows(Contender& c, std::vector<Row>& rows) {
  const auto n = static_cast<double>(c.coherent.size());
  add_queries(c, rows);
  rows.push_back({c.name + ": query, all distances, coherent, frames, the proxy turning by a millimeter, too",
                  [&c] {
                    Frames& frames = c.beside_moving;
                    c.moving.query({}, frames.now().particles(), c.contacts, frames.workspace);
                  },
                  n, 0.0,
                  [&c] {
                    c.beside_moving.step();
                    c.move_rigidly(2e-3);
                  },
                  bench::kFrameCalls});
  const double first_bar = c.relief ? 55.0 : 40.0;
  rows.push_back({c.name + ": query, random, first call, fresh workspace",
                  [&c] {
                    Workspace fresh;
                    c.collider.query({}, c.frames[1].now().particles(), c.contacts, fresh);
                  },
                  n, first_bar});
  rows.push_back({c.name + ": query, random, first call, no workspace",
                  [&c] { c.collider.query({}, c.frames[1].now().particles(), c.contacts); }, n, first_bar});
  add_responses(c, rows);
  rows.push_back({c.name + ": update of a proxy that moved rigidly (not a particle)",
                  [&c] { c.move_rigidly(0.01); }, 1.0, 20e3});
}

void print_ratio(const std::string& what, const Row& over, const Row& under, const std::string& bar) {
  std::printf("| %s | %.2f | %.2f | %s |\n", what.c_str(), over.median() / under.median(),
              over.least() / under.least(), bar.c_str());
}

/// Prints the promised ratios: response to query, and Embree to the query that gives the same information.
void print_ratios(const std::vector<std::unique_ptr<Contender>>& contenders, const std::vector<Row>& rows,
                  bool embree) {
  std::printf("\n| ratio | of medians | of mins | bar |\n|---|---|---|---|\n");
  for (const auto& c : contenders)
    for (const std::string order : {", coherent, nothing kept", kFrames[0], kFrames[1]}) {
      const std::string all = c->name + ": query, " + kQueryKinds[0].name + order;
      print_ratio(c->name + order + ": response to query", row_of(rows, c->name + ": response" + order),
                  row_of(rows, all), "at most 2");
    }
  for (const auto& c : contenders)
    for (const QueryKind& q : kQueryKinds)
      for (const double reach_m : kEmbreeReaches_m) {
        const bool deep_missed = reach_m == kShortReach_m;
        if (!embree || (deep_missed && q.options.within_m != kShort_m)) continue;
        if (std::isinf(reach_m) && !std::isinf(q.options.within_m)) continue;
        for (const std::string how : {", coherent, nothing kept", kFrames[0]})
          print_ratio(c->name + how + ": " + bench::embree_name(reach_m) +
                          (deep_missed ? " (no result for deeper ones)" : "") + ", to query, " + q.name,
                      row_of(rows, bench::embree_name(reach_m) + ", coherent"),
                      row_of(rows, c->name + ": query, " + q.name + how),
                      c->relief ? "at least 30" : "at least 100");
      }
}

void write_csv(const std::string& file, const std::vector<Row>& rows, const bench::Origin& origin,
               int repeats) {
  std::ofstream out(file);
  out << "# " << bench::title(origin) << "; " << origin.flags << "; repeats " << repeats << "\n";
  out << "row,ns_median,ns_min\n";
  for (const Row& row : rows) out << '"' << row.name << "\"," << row.median() << ',' << row.least() << '\n';
}

constexpr const char* kUsage =
    "collision [PARTICLES [REPEATS [FIT_SECONDS [ROWS.csv]]]]    default: 100000 11 4\n"
    "collision figures [LARGEST_BODY]\n"
    "collision counts [PARTICLES [REPEATS]]\n"
    "Cost of a query and of a response a particle, with its error, beside other methods that can answer the "
    "same.\n";

}  // namespace

int main(int argc, char** argv) {
  if (bench::help_requested(argc, argv, kUsage)) return 0;
  if (argc > 1 && std::string_view(argv[1]) == "figures")
    return bench::draw_figures(argc > 2 ? static_cast<std::size_t>(std::atol(argv[2])) : 856000) ? 0 : 1;
  if (argc > 1 && std::string_view(argv[1]) == "counts") {
    bench::grow_counts(argc > 2 ? static_cast<std::size_t>(std::atol(argv[2])) : 100000,
                       argc > 3 ? std::atoi(argv[3]) : 3);
    return 0;
  }
  const std::size_t count = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) : 100000;
  const int repeats = argc > 2 ? std::max(1, std::atoi(argv[2])) : 11;
  const double fit_s = argc > 3 ? std::atof(argv[3]) : 4.0;

  const bench::Origin origin = bench::find_origin();
  const auto body = bench::make_subject(8850);
  const bodice::geometry::MeshDistance skin({}, body.mesh);
  const bench::Cloud random = bench::near_skin(body.mesh, count, kBand_m, 1);
  const bench::Cloud coherent = bench::coherent(random);
  std::vector<double> truth;
  for (std::size_t i = 0; i < count; ++i) truth.push_back(skin.signed_distance(coherent.at(i)));

  std::printf(
      "%s; %s; %zu particles within %.0f mm of a body of %zu vertices; one thread, CPU time, %d "
      "repeats. A query returns signed distance, closest point, normal and ellipsoid; peers the distance "
      "alone, without sign but for grids. The bars of 7.5 and 15 ns (30 and 60 with relief) come from a "
      "prototype of 'inside only' by estimates; they apply to exact distances of all "
      "as well. 'Frames': particles "
      "drift by a millimeter a call with a workspace, the mean of %d calls; 'nothing kept': "
      "without one. A peer without sign must look as far for that as for all distances.\n\n",
      bench::title(origin).c_str(), origin.flags.c_str(), count, 1e3 * kBand_m, body.mesh.positions.size(),
      repeats, bench::kFrameCalls);

  std::vector<std::unique_ptr<Contender>> contenders;
  std::unique_ptr<bench::Limits> limits;
  for (const Tier tier : {Tier::kTight, Tier::kRelief}) {
    const auto proxy = bench::fit_subject(body, skin, tier, kEllipsoids, fit_s);
    const std::string label = std::string(bodice::proxy::name(tier)) + ", " +
                              std::to_string(proxy.ellipsoids().size()) + " ellipsoids";
    contenders.push_back(std::make_unique<Contender>(label, proxy, coherent, random));
    if (!limits) limits = std::make_unique<bench::Limits>(proxy, count, kBand_m);
    Contender& c = *contenders.back();
    std::printf("%s: error %s mm, %.0f kB\n", label.c_str(),
                error_of(c.distances(Accuracy::kExact), truth, true).c_str(),
                1e-3 * static_cast<double>(proxy.bytes()));
    for (const double near_m : {kBand_m, double{kShort_m}})
      std::printf("to first order, within %.0f mm: error %s mm\n", 1e3 * near_m,
                  error_of(c.distances(Accuracy::kFirstOrder), truth, true, near_m).c_str());
  }
  std::vector<bench::Peer> peers;
  for (const double reach_m : kEmbreeReaches_m)
    for (bench::Peer& peer : bench::embree_peers(body.mesh, reach_m)) peers.push_back(std::move(peer));
  const bool embree = !peers.empty();
  if (!embree) std::printf("Embree is not installed here: not measured\n");
  for (bench::Peer& peer : bench::cgal_peers(body.mesh)) peers.push_back(std::move(peer));
  const std::size_t without_fcl = peers.size();
  for (bench::Peer& peer : bench::fcl_peers(body.mesh)) peers.push_back(std::move(peer));
  if (peers.size() == without_fcl) std::printf("FCL is not installed here: not measured\n");
  for (const double cell_m : {0.010, 0.005}) peers.push_back(bench::grid_peer(body.mesh, skin, cell_m));
  std::vector<Row> rows;
  limits->add_to(rows);
  for (auto& contender : contenders) add_rows(*contender, rows);
  std::vector<float> distances(count);
  std::deque<bench::SampledPeer> sampled;
  for (bench::Peer& peer : peers)
    bench::add_peer(sampled.emplace_back(peer, coherent, random), truth, distances, rows);
  bench::measure(rows, repeats);
  std::printf("\n| question | ns a particle, median | min | bar |\n|---|---|---|---|\n");
  for (const Row& row : rows) {
    std::printf("| %s | %.1f | %.1f |", row.name.c_str(), row.median(), row.least());
    if (row.bar > 0.0) std::printf(" %.1f", row.bar);
    std::puts(" |");
  }
  print_ratios(contenders, rows, embree);
  std::printf(
      "\n| query, coherent | least ns a particle | to the best target (bar for AVX2: 1.6) "
      "|\n|---|---|---|\n");
  for (auto& c : contenders)
    for (const Accuracy accuracy : {Accuracy::kExact, Accuracy::kFirstOrder})
      bench::compare_targets(
          c->name + (accuracy == Accuracy::kExact ? "" : ", to first order"),
          [&] { c->collider.query({}, c->coherent.particles(), c->contacts, {.accuracy = accuracy}); },
          static_cast<double>(count), repeats);
  if (argc > 4) write_csv(argv[4], rows, origin, repeats);
  return 0;
}
