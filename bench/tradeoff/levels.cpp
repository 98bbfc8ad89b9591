#include "levels.hpp"

namespace tradeoff {
namespace {

constexpr double kLevels_mm[] = {0.5, 1.0, 2.0, 5.0, 10.0, 20.0};
constexpr const char* kTimed = "_timed";

/// `timed` is the suffix of columns that depend on times but are none.
bench::Table levels(const char* name, const char* caption, const std::string& unit, const std::string& timed,
                    double scale, const std::vector<std::string>& names, std::span<const Offer> offers,
                    const std::vector<bool>& ours) {
  bench::Table table(name, caption,
                     {"error_at_most_mm", "ours" + timed, "cost_" + unit, "best_peer" + timed,
                      "its_cost_" + unit, "peer_over_ours" + timed});
  for (const double level : kLevels_mm) {
    const auto mine = cheapest(offers, ours, true, level), theirs = cheapest(offers, ours, false, level);
    std::vector<bench::Cell> row{level, "none", "", "none", "", ""};
    if (mine) row[1] = names[*mine], row[2] = scale * offers[*mine].cost;
    if (theirs) row[3] = names[*theirs], row[4] = scale * offers[*theirs].cost;
    if (mine && theirs) row[5] = offers[*theirs].cost / offers[*mine].cost;
    table.add(std::move(row));
  }
  return table;
}

}  // namespace

bench::Table levels_by_time(const std::vector<std::string>& names, std::span<const Offer> offers,
                            const std::vector<bool>& ours) {
  return levels("levels_time", "The least time a particle at a mean error, and that of the best peer.", "ns",
                kTimed, 1.0, names, offers, ours);
}

bench::Table levels_by_moving_frame(const std::vector<std::string>& names, std::span<const Offer> offers,
                                    const std::vector<bool>& ours) {
  return levels(
      "levels_moving",
      "The same for a frame of 10,000 particles on a body that has moved: its update and the queries.", "us",
      kTimed, 1.0, names, offers, ours);
}

bench::Table levels_by_bytes(const std::vector<std::string>& names, std::span<const Offer> offers,
                             const std::vector<bool>& ours) {
  return levels("levels_memory", "The least memory at a mean error, and that of the best peer of known size.",
                "KB", "", 1e-3, names, offers, ours);
}

}  // namespace tradeoff
