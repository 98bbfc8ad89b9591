// Collider::cover(): relief rises where points of the skin are outside of the surface.
#include <algorithm>
#include <tuple>

#include <bodice/engine/parallel.hpp>

#include "collider/collider_impl.hpp"
#include "collider/cover_scratch.hpp"

namespace bodice::inline v0_1::collision {
namespace {

using geometry::Vec3;

constexpr int kMostRounds = 3;  // after three, one point in a thousand of those that were outside still is
/// Points farther outside than so many radii of blending are not of the surface.
constexpr float kFarthest = 10.0f;
/// A point is raised to this share of the tolerance: to zero, the surface would lie over the skin around it.
constexpr float kLeftShare = 0.8f;
/// An ellipsoid without a table has a flat one of two nodes a side, which is not its own and may not rise.
constexpr int kLeastNodes = 3;
constexpr std::size_t kOwnerGrain = 4;  // tables a task, some microseconds each
constexpr std::size_t kPointGrain = 1024;
constexpr std::size_t kBoxesAGroup = 16;  // a garment of 15,000 vertices has about 256 boxes

bool is_within(const Vec3& point, const geometry::Box& box) {
  return (point.array() >= box.low.array()).all() && (point.array() <= box.high.array()).all();
}

/// The boxes of Collider::cover() in groups of consecutive ones, so that most points need few tests.
class BoxGroups {
 public:
  /// Keeps the bounds of the groups in `bounds`, which must outlive this.
  BoxGroups(std::span<const geometry::Box> boxes, std::vector<geometry::Box>& bounds) : boxes_(boxes) {
    bounds.assign(engine::block_count(boxes.size(), kBoxesAGroup), {});
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      if (!(boxes[k].low.array() <= boxes[k].high.array()).all()) continue;  // it has no point
      bounds[k / kBoxesAGroup].extend(boxes[k].low);
      bounds[k / kBoxesAGroup].extend(boxes[k].high);
    }
    bounds_ = bounds;
  }

  /// Whether a box has the point; `last` is the box that had the point before. Neighbors in an array of
  /// vertices are mostly neighbors on the skin, so that this box is tried first.
  bool have(const Vec3& point, std::size_t& last) const {
    if (last < boxes_.size() && is_within(point, boxes_[last])) return true;
    for (std::size_t g = 0; g < bounds_.size(); ++g) {
      if (!is_within(point, bounds_[g])) continue;
      for (last = g * kBoxesAGroup; last < std::min((g + 1) * kBoxesAGroup, boxes_.size()); ++last)
        if (is_within(point, boxes_[last])) return true;
    }
    return false;
  }

 private:
  std::span<const geometry::Box> boxes_, bounds_;
};

/// Lists the points that are finite and within the boxes.
void list_points(const engine::Context& context, std::span<const Vec3> skin, const CoverOptions& options,
                 CoverScratch& scratch) {
  const BoxGroups boxes(options.within.value_or(std::span<const geometry::Box>()), scratch.bounds);
  engine::parallel_for(context, skin.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
    std::size_t last = 0;
    for (std::size_t i = begin; i < end; ++i)
      scratch.is_listed[i] = skin[i].allFinite() && (!options.within || boxes.have(skin[i], last));
  });
  scratch.point.clear();
  for (std::size_t i = 0; i < skin.size(); ++i)
    if (scratch.is_listed[i] != 0) scratch.point.push_back(static_cast<std::uint32_t>(i));
}

void gather(std::span<const Vec3> skin, const Vec3& origin, CoverScratch& scratch) {
  const std::size_t count = scratch.point.size();
  for (auto* axis : {&scratch.x, &scratch.y, &scratch.z}) axis->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f local = (skin[scratch.point[i]] - origin).cast<float>();
    scratch.x[i] = local.x(), scratch.y[i] = local.y(), scratch.z[i] = local.z();
  }
}

/// Sorts the uncovered points by owner, and finds those of each.
void find_owners(CoverScratch& scratch) {
  std::ranges::sort(scratch.uncovered, {},
                    [](const UncoveredPoint& u) { return std::tuple(u.owner, u.point); });
  scratch.owners.clear();
  for (std::size_t i = 0; i < scratch.uncovered.size(); ++i) {
    if (i == 0 || scratch.uncovered[i].owner != scratch.uncovered[i - 1].owner)
      scratch.owners.push_back({i, i});
    scratch.owners.back().end = i + 1;
  }
}

}  // namespace

void CoverScratch::reserve(std::size_t points, std::size_t ellipsoids, std::size_t texels) {
  point.reserve(points);
  for (auto* axis : {&x, &y, &z}) axis->reserve(points);
  if (contacts.size() < points) contacts.resize(points);
  uncovered.reserve(points);
  is_listed.resize(points);
  owners.reserve(ellipsoids);
  rise_m.resize(texels);
}

void Collider::Impl::find_uncovered(const engine::Context& context, std::span<const Vec3> skin,
                                    float tolerance_m) {
  gather(skin, origin, cover);
  const Particles points{cover.point.size(), cover.x.data(), cover.y.data(), cover.z.data()};
  engine::parallel_for(context, points.count, kBatch, [&](std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; at += kBatch)
      query_range(points, at, std::min(at + kBatch, end), {}, {}, cover.contacts);
  });
  const float farthest_m = kFarthest * model.relief->blend_m;
  cover.uncovered.clear();
  for (std::size_t i = 0; i < points.count; ++i) {
    const Contact& contact = cover.contacts[i];
    if (!(contact.signed_distance > tolerance_m && contact.signed_distance <= farthest_m)) continue;
    const std::uint32_t owner = internal_index[contact.ellipsoid];
    if (model.relief->tables[owner].nodes < kLeastNodes) continue;
    cover.uncovered.push_back({owner,
                               cover.point[i],
                               contact.signed_distance - kLeftShare * tolerance_m,
                               {cover.x[i], cover.y[i], cover.z[i]}});
  }
}

void Collider::Impl::raise_uncovered(const engine::Context& context) {
  find_owners(cover);
  engine::parallel_for(context, cover.owners.size(), kOwnerGrain, [&](std::size_t begin, std::size_t end) {
    for (const OwnerSpan& span : std::span(cover.owners).subspan(begin, end - begin)) {
      const auto points = std::span(cover.uncovered).subspan(span.begin, span.end - span.begin);
      const BakedTable& table = model.relief->tables[points.front().owner];
      const auto first = static_cast<std::size_t>(table.first_byte) / 2;
      const auto nodes = static_cast<std::size_t>(table.nodes);
      raise_table(field, points, *model.relief, std::span(cover.rise_m).subspan(first, nodes * nodes));
    }
  });
  model.relief->bound_all_again();
}

CoverReport Collider::cover(const engine::Context& context, std::span<const Vec3> skin,
                            const CoverOptions& options) {
  CoverReport report;
  if (!has_relief() || !(options.tolerance_m >= 0.0f)) return report;
  CoverScratch& scratch = impl_->cover;
  scratch.reserve(skin.size(), size(), impl_->texels);
  list_points(context, skin, options, scratch);
  for (int round = 0;; ++round) {
    impl_->find_uncovered(context, skin, options.tolerance_m);
    report.left = scratch.uncovered.size();
    report.left_m = 0.0f;
    for (const UncoveredPoint& u : scratch.uncovered)
      report.left_m = std::max(report.left_m, u.rise_m + kLeftShare * options.tolerance_m);
    if (round == 0) report.uncovered = report.left, report.farthest_m = report.left_m;
    if (round == kMostRounds || scratch.uncovered.empty()) return report;
    impl_->raise_uncovered(context);
    scratch.point.clear();
    for (const UncoveredPoint& u : scratch.uncovered) scratch.point.push_back(u.point);
  }
}

}  // namespace bodice::collision
