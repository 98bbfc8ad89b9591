#include "crossed.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

#include <bodice/tryon/skin_room.hpp>

#include "conditions.hpp"

namespace bench {
namespace {

using namespace bodice;

constexpr std::size_t kListedPairs = 6;

/// What two layers take: each its distance from the skin, and the gap between them.
double needed_m(const Judged& j) {
  return 2.0 * j.draped.report.thickness_m + tryon::DrapeOptions{}.solver.layer_gap_m;
}

std::vector<tryon::JudgedCrossing> judge(const engine::Context& context, const Judged& j, std::size_t frame) {
  const geometry::TriMesh skin{j.draped.body_frames[frame], j.body.skin.input.skin.triangles};
  const geometry::MeshDistance distance(context, skin);
  return tryon::judge_crossings(context, {skin, distance}, j.draped.garments.front().frames[frame],
                                j.garment.triangles, needed_m(j));
}

/// The part of the body that a triangle of the garment lay on at the start.
body::Part part_below(const Judged& j, std::size_t triangle) {
  const tryon::SegmentedSkin& skin = j.body.skin;
  const geometry::Index below =
      skin.distance->closest_point(j.garment.positions[j.garment.triangles[triangle][0]]).triangle;
  return skin.anatomy.part[skin.input.skin.triangles[below][0]];
}

}  // namespace

std::vector<Crossed> find_crossed(const engine::Context& context, const Judged& j) {
  std::vector<bool> pressed(j.garment.triangles.size(), false);
  std::vector<Crossed> frames;
  for (std::size_t frame = 0; frame < j.draped.body_frames.size(); ++frame) {
    Crossed& sum = frames.emplace_back();
    const auto judged = judge(context, j, frame);
    for (const tryon::JudgedCrossing& c : judged) {
      const auto& [s, t] = c.triangles;
      ++(c.has_room ? sum.with_room : sum.without_room);
      sum.pressed_before += c.has_room && (pressed[s] || pressed[t]);
    }
    for (const tryon::JudgedCrossing& c : judged)
      for (const std::size_t t : c.triangles) pressed[t] = pressed[t] || !c.has_room;
  }
  return frames;
}

CrossedSpan span_of(const std::vector<Crossed>& frames) {
  CrossedSpan span{.worst = {}, .end = frames.back()};
  for (std::size_t k = kFirstFrames; k < frames.size(); ++k) {
    if (frames[k].with_room >= span.worst.with_room)
      span.worst.with_room = frames[k].with_room, span.worst.pressed_before = frames[k].pressed_before;
    span.worst.without_room = std::max(span.worst.without_room, frames[k].without_room);
  }
  return span;
}

void print_crossed(const engine::Context& context, const Judged& j, std::size_t frame) {
  std::map<std::string, std::size_t> by_parts[2];
  std::size_t count[2] = {0, 0};
  for (const tryon::JudgedCrossing& c : judge(context, j, frame)) {
    auto parts = std::minmax({body::kPartNames[static_cast<std::size_t>(part_below(j, c.triangles[0]))],
                              body::kPartNames[static_cast<std::size_t>(part_below(j, c.triangles[1]))]});
    ++by_parts[c.has_room][std::string(parts.first) + " x " + std::string(parts.second)];
    ++count[c.has_room];
  }
  for (const int room : {1, 0}) {
    std::vector<std::pair<std::size_t, std::string>> sorted;
    for (const auto& [parts, pairs] : by_parts[room]) sorted.push_back({pairs, parts});
    std::ranges::sort(sorted, std::greater<>());
    std::printf("  frame %zu, crossings %-12s %5zu", frame, room ? "with room" : "without room", count[room]);
    for (std::size_t k = 0; k < std::min(kListedPairs, sorted.size()); ++k)
      std::printf("%s %s %zu", k == 0 ? " |" : ",", sorted[k].second.c_str(), sorted[k].first);
    std::printf("\n");
  }
}

}  // namespace bench
