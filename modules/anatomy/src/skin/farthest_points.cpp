// Based on: Teofilo F. Gonzalez. Clustering to minimize the maximum intercluster distance. 1985. - farthest
// points, one after the other.
// Differs: each point depends on the one before, so a run has nothing to share out; the distances from the
// point that will probably come next are measured beside those from the one that is known, and thrown away if
// another comes.
#include "skin/farthest_points.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::anatomy {
namespace {

using geodesic::Field;
using geometry::Index;
using geometry::kNoIndex;

/// The vertex of the body's own component that lies farthest from its middle: an end, or near one.
Index start_vertex(const Skin& skin) {
  geometry::Vec3 middle = geometry::Vec3::Zero();
  double area = 0.0;
  for (std::size_t f = 0; f < skin.mesh.triangles.size(); ++f) {
    if (skin.component[skin.mesh.triangles[f][0]] != 0) continue;
    const double a = geometry::area_vector(skin.mesh, f).norm();
    const auto& corner = skin.mesh.triangles[f];
    middle += a * (skin.mesh.positions[corner[0]] + skin.mesh.positions[corner[1]] +
                   skin.mesh.positions[corner[2]]);
    area += 3.0 * a;
  }
  if (area > 0.0) middle /= area;
  Index best = 0;
  double most = -1.0;
  for (std::size_t v = 0; v < skin.mesh.positions.size(); ++v) {
    const double d = (skin.mesh.positions[v] - middle).squaredNorm();
    if (skin.component[v] == 0 && d > most) {
      most = d;
      best = static_cast<Index>(v);
    }
  }
  return best;
}

Index farthest(const Field& field) {
  Index best = kNoIndex;
  for (std::size_t v = 0; v < field.size(); ++v)
    if (std::isfinite(field[v]) && (best == kNoIndex || field[v] > field[best])) best = static_cast<Index>(v);
  return best;
}

bool is_peak(const Skin& skin, const Field& field, Index v) {
  for (Index k = skin.graph.offset[v]; k < skin.graph.offset[v + 1]; ++k)
    if (field[skin.graph.links[k].to] > field[v]) return false;
  return true;
}

/// A peak this near to the point just taken, of that point's distance, falls with it: another toe of its
/// foot.
constexpr double kSameEnd = 0.2;

/// The highest peak of the distance from what was taken before `now`, away from `now`: only near it does the
/// distance change, so this mostly comes next.
Index probably_next(const Skin& skin, const Field& nearest, Index now) {
  const double near = kSameEnd * static_cast<double>(nearest[now]);
  const auto& p = skin.mesh.positions;
  Index best = kNoIndex;
  for (Index v = 0; v < nearest.size(); ++v) {
    if (!std::isfinite(nearest[v]) || (best != kNoIndex && nearest[v] <= nearest[best])) continue;
    if ((p[v] - p[now]).squaredNorm() > near * near && is_peak(skin, nearest, v)) best = v;
  }
  return best;
}

}  // namespace

FarthestPoints farthest_points(const engine::Context& context, const Skin& skin, std::size_t count) {
  FarthestPoints points;
  Field nearest, ahead;
  Index next = kNoIndex;  // where `ahead` is measured from
  const bool alone = context.executor->concurrency() < 2;
  for (Index now = start_vertex(skin); points.vertex.size() < count; now = farthest(nearest)) {
    if (!nearest.empty() && !(now != kNoIndex && nearest[now] > 0.0F)) break;
    Field field;
    if (points.vertex.size() + 1 == count) {
      points.vertex.push_back(now);
      points.field.emplace_back();
      break;
    }
    if (now == next) {
      field = std::move(ahead);
      next = kNoIndex;
    } else {
      const bool last = nearest.empty() || points.vertex.size() + 2 == count;
      next = last || alone ? kNoIndex : probably_next(skin, nearest, now);
      engine::parallel_for(context, next == kNoIndex ? 1 : 2, 1, [&](std::size_t i, std::size_t) {
        (i == 0 ? field : ahead) = geodesic::distances_from(skin.graph, i == 0 ? now : next);
      });
    }
    if (nearest.empty()) nearest = field;
    for (std::size_t v = 0; v < field.size(); ++v) nearest[v] = std::min(nearest[v], field[v]);
    points.vertex.push_back(now);
    points.field.push_back(std::move(field));
  }
  return points;
}

}  // namespace bodice::anatomy
