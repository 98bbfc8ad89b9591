#include <algorithm>
#include <map>

#include <bodice/colliders/reduce.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/proxy/proxy_distance.hpp>

#include "fit_shapes.hpp"

namespace bodice::inline v0_1::colliders {
namespace {

using Members = std::vector<std::uint32_t>;

/// Points that shapes are fitted to: more change a body's errors by less than a tenth of a millimeter.
constexpr std::size_t kMostFitted = 8000;
/// A shape with fewer points is not split.
constexpr std::size_t kLeastSplit = 16;
constexpr int kStepsASplit = 6, kLastSteps = 60;

/// Every so many of the points with area.
SkinPoints thinned(const SkinPoints& all) {
  std::vector<std::size_t> kept;
  for (std::size_t p = 0; p < all.position.size(); ++p)
    if (all.area[p] > 0.0) kept.push_back(p);
  const std::size_t stride = std::max<std::size_t>(1, kept.size() / kMostFitted);
  SkinPoints few;
  for (std::size_t i = 0; i < kept.size(); i += stride) {
    few.position.push_back(all.position[kept[i]]);
    few.area.push_back(all.area[kept[i]]);
    few.owner.push_back(all.owner[kept[i]]);
  }
  return few;
}

/// The bone of an ellipsoid, or its part where it has none.
int group_of(const proxy::ProxyEllipsoid& ellipsoid) {
  return ellipsoid.bone != proxy::kNoBone ? ellipsoid.bone : -1 - static_cast<int>(ellipsoid.part);
}

Vec3 mean_of(const SkinPoints& points, const Members& members) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t p : members) sum += points.position[p];
  return sum / static_cast<double>(members.size());
}

/// The points of each bone or part; the smallest join their nearest until there are few enough.
std::vector<Members> groups_of(const proxy::BodyProxy& proxy, const SkinPoints& points, std::size_t most) {
  std::map<int, Members> by_group;
  for (std::uint32_t p = 0; p < points.owner.size(); ++p)
    by_group[group_of(proxy.ellipsoids()[points.owner[p]])].push_back(p);
  std::vector<Members> groups;
  for (auto& [group, members] : by_group) groups.push_back(std::move(members));
  while (groups.size() > most) {
    const auto least = std::ranges::min_element(groups, {}, &Members::size);
    const Members joining = std::move(*least);
    groups.erase(least);
    const Vec3 center = mean_of(points, joining);
    const auto nearest = std::ranges::min_element(
        groups, {}, [&](const Members& g) { return (mean_of(points, g) - center).squaredNorm(); });
    nearest->insert(nearest->end(), joining.begin(), joining.end());
  }
  return groups;
}

/// Splits the shape with the largest sum of squared distances; false if no shape can be split.
bool split_worst(const SkinPoints& points, ShapeKind kind, const Assignment& current,
                 std::vector<PlainShape>& shapes) {
  std::vector<double> sum(shapes.size(), 0.0);
  std::vector<Members> members(shapes.size());
  for (std::uint32_t p = 0; p < points.position.size(); ++p) {
    const std::uint32_t s = current.shape[p];
    sum[s] += points.area[p] * current.nearest[p].distance * current.nearest[p].distance;
    members[s].push_back(p);
  }
  for (std::size_t s = 0; s < shapes.size(); ++s)
    if (members[s].size() < kLeastSplit) sum[s] = 0.0;
  const auto worst = static_cast<std::size_t>(std::ranges::max_element(sum) - sum.begin());
  if (!(sum[worst] > 0.0)) return false;
  const auto sides = halves(points, members[worst]);
  if (sides[0].empty() || sides[1].empty()) return false;
  shapes[worst] = shape_around(points, sides[0], kind);
  shapes.push_back(shape_around(points, sides[1], kind));
  return true;
}

/// Gives each shape the bone and the part of most of its points; drops those without points.
void name_shapes(const proxy::BodyProxy& proxy, const SkinPoints& points, const Assignment& current,
                 std::vector<PlainShape>& shapes) {
  std::vector<std::map<std::pair<std::int16_t, body::Part>, double>> area(shapes.size());
  for (std::size_t p = 0; p < points.position.size(); ++p) {
    const proxy::ProxyEllipsoid& owner = proxy.ellipsoids()[points.owner[p]];
    area[current.shape[p]][{owner.bone, owner.part}] += points.area[p];
  }
  std::vector<PlainShape> named;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    if (area[s].empty()) continue;
    const auto most = std::ranges::max_element(area[s], {}, [](const auto& entry) { return entry.second; });
    shapes[s].bone = most->first.first, shapes[s].part = most->first.second;
    named.push_back(shapes[s]);
  }
  shapes = std::move(named);
}

}  // namespace

SkinPoints skin_points(const engine::Context& context, const proxy::BodyProxy& proxy,
                       const geometry::TriMesh& mesh) {
  SkinPoints points;
  points.position = mesh.positions;
  points.area.assign(mesh.positions.size(), 0.0);
  points.owner.resize(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const geometry::Index v : mesh.triangles[t])
      points.area[v] += geometry::area_vector(mesh, t).norm() / 6.0;
  engine::parallel_for(context, points.position.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      points.owner[p] = proxy::proxy_distance(proxy, points.position[p]).owner;
  });
  return points;
}

engine::Result<std::vector<PlainShape>> reduce(const engine::Context& context, const proxy::BodyProxy& proxy,
                                               const SkinPoints& points, ShapeKind kind, int count) {
  if (count < 1 || count > kMaxShapes)
    return engine::Error{engine::ErrorCode::kInvalidArgument,
                         engine::message("A collider of ", count, " shapes cannot be fitted."),
                         engine::message("Ask for 1 to ", kMaxShapes, ".")};
  const SkinPoints few = thinned(points);
  if (few.position.empty() || proxy.ellipsoids().empty())
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "The proxy has no surface that shapes could be fitted to.",
                         "Fit a proxy to the whole body."};
  std::vector<PlainShape> shapes;
  for (const Members& group : groups_of(proxy, few, static_cast<std::size_t>(count)))
    shapes.push_back(shape_around(few, group, kind));
  Assignment current = assign(context, few, shapes);
  descend(context, few, kind, kStepsASplit, shapes, current);
  while (shapes.size() < static_cast<std::size_t>(count)) {
    if (!split_worst(few, kind, current, shapes)) break;
    current = assign(context, few, shapes);
    descend(context, few, kind, kStepsASplit, shapes, current);
  }
  descend(context, few, kind, kLastSteps, shapes, current);
  name_shapes(proxy, few, current, shapes);
  return shapes;
}

}  // namespace bodice::colliders
