#include "cover/cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/mvee.hpp>

#include "cover/triangle_levels.hpp"
#include "mvee/mvee_finish.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

using geometry::Ellipsoid;

constexpr int kPasses = 4;  // of growing, before what remains is covered by stretching

std::array<Vec3, 12> icosahedron() {
  const double g = std::numbers::phi, length = std::sqrt(1.0 + g * g);
  std::array<Vec3, 12> corners;
  std::size_t n = 0;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g}) {
      corners[n++] = Vec3(0.0, a, b) / length;
      corners[n++] = Vec3(a, b, 0.0) / length;
      corners[n++] = Vec3(b, 0.0, a) / length;
    }
  return corners;
}

/// Calls f(batch, begin) for the triangles that `which` lists (as indices into `triangles`), a batch at a
/// time.
template <class F>
void for_each_batch(const geometry::TriMesh& mesh, std::span<const Index> triangles,
                    std::span<const Index> which, F&& f) {
  TriangleBatch batch;
  for (std::size_t begin = 0; begin < which.size(); begin += TriangleBatch::kMost) {
    batch.count = 0;
    for (const Index t : which.subspan(begin, std::min(TriangleBatch::kMost, which.size() - begin))) {
      const std::size_t triangle = triangles[t];
      batch.add(mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2));
    }
    f(batch, begin);
  }
}

std::vector<Index> all_of(std::span<const Index> triangles) {
  std::vector<Index> all(triangles.size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

/// The ellipsoid that holds a triangle, or the one that has to grow for it.
struct Home {
  std::uint32_t ellipsoid = 0;
  bool held = false;
};

/// Brings the homes of the triangles that `which` lists up to date.
void find_homes(const engine::Context& context, const geometry::TriMesh& mesh,
                std::span<const Index> triangles, std::span<const Index> which,
                const std::vector<Ellipsoid>& ellipsoids, std::vector<Home>& home) {
  const std::vector<LevelForm> forms(ellipsoids.begin(), ellipsoids.end());
  engine::parallel_for(
      context, which.size(), 4 * TriangleBatch::kMost, [&](std::size_t begin, std::size_t end) {
        const auto mine = which.subspan(begin, end - begin);
        TriangleHomes found;
        for_each_batch(mesh, triangles, mine, [&](const TriangleBatch& batch, std::size_t first) {
          found.clear(batch.count);
          for (std::uint32_t e = 0; e < forms.size(); ++e) {
            offer_home(forms[e], e, batch, found);
            if (e % 4 == 3 && found.all_held(batch.count)) break;
          }
          for (std::size_t i = 0; i < batch.count; ++i)
            home[mine[first + i]] = {found.ellipsoid[i], found.held(i)};
        });
      });
}

/// The corners of triangles that are not held, grouped by the ellipsoid that has to grow for them.
class CornersToHold {
 public:
  CornersToHold(std::size_t vertices, std::size_t ellipsoids) : of_(ellipsoids), last_(vertices, 0) {}

  void collect(const geometry::TriMesh& mesh, std::span<const Index> triangles,
               const std::vector<Home>& home) {
    for (auto& mine : of_) mine.clear();
    stamp_ += static_cast<std::uint32_t>(of_.size());
    for (std::size_t t = 0; t < home.size(); ++t)
      if (!home[t].held)
        for (const Index v : mesh.triangles[triangles[t]]) add(mesh, v, home[t].ellipsoid);
  }
  const std::vector<Vec3>& of(std::size_t e) const { return of_[e]; }

 private:
  /// Adds a corner once, although several triangles share it: most often they have the same ellipsoid.
  void add(const geometry::TriMesh& mesh, Index v, std::uint32_t e) {
    if (last_[v] == stamp_ + e) return;
    last_[v] = stamp_ + e;
    of_[e].push_back(mesh.positions[v]);
  }

  std::vector<std::vector<Vec3>> of_;
  std::vector<std::uint32_t> last_;  // #V: the stamp of the round and ellipsoid that added the vertex last
  std::uint32_t stamp_ = 1;
};

}  // namespace

Ellipsoid grown(const Ellipsoid& ellipsoid, std::span<const Vec3> points) {
  static constexpr double kVolumeTolerance = 1e-3;  // changes radii by a third of a thousandth
  constexpr double kSlack = 1.0 + 1e-9;             // holds the points on the surface under rounding
  std::vector<Vec3> all(points.begin(), points.end());
  for (const Vec3& u : icosahedron())
    all.push_back(ellipsoid.center + ellipsoid.axes * ellipsoid.radii.cwiseProduct(u));
  Ellipsoid e = mvee(all, {kVolumeTolerance, ellipsoid.radii.minCoeff()}).ellipsoid;
  e.radii *= kSlack;
  return e;
}

Ellipsoid stretched(const Ellipsoid& e, const Vec3& point) {
  constexpr double kSlack = 1.0 + 1e-9;  // covers the rounding of the new axes
  const Vec3 y = (e.axes.transpose() * (point - e.center)).cwiseQuotient(e.radii);
  const double rho = y.norm() * kSlack;
  if (!(rho > 1.0)) return e;
  const Vec3 u = y.normalized();
  const double a = 0.5 * (1.0 + rho), b = std::sqrt(a);
  const geometry::Mat3 shape = b * geometry::Mat3::Identity() + (a - b) * u * u.transpose();
  const geometry::Mat3 half = e.axes * e.radii.asDiagonal() * shape;
  Ellipsoid result = spanned(e.center + e.axes * e.radii.cwiseProduct(0.5 * (rho - 1.0) * u), half);
  result.radii *= kSlack;
  return result;
}

void cover_triangles(const engine::Context& context, const geometry::TriMesh& mesh,
                     std::span<const Index> triangles, std::vector<Ellipsoid>& ellipsoids) {
  if (ellipsoids.empty()) return;
  std::vector<Home> home(triangles.size());
  CornersToHold corners(mesh.positions.size(), ellipsoids.size());
  std::vector<Index> unsure = all_of(triangles);
  for (int pass = 0; pass <= kPasses; ++pass) {
    find_homes(context, mesh, triangles, unsure, ellipsoids, home);
    corners.collect(mesh, triangles, home);
    const auto grows = [&](std::size_t e) { return !corners.of(e).empty(); };
    // A grown ellipsoid may not hold everything that it held before. A stretched one does, so that the last
    // pass ends it.
    const bool last = pass == kPasses;
    engine::parallel_for(context, ellipsoids.size(), 1, [&](std::size_t e, std::size_t) {
      if (!grows(e)) return;
      if (!last) ellipsoids[e] = grown(ellipsoids[e], corners.of(e));
      for (std::size_t i = 0; last && i < corners.of(e).size(); ++i)
        ellipsoids[e] = stretched(ellipsoids[e], corners.of(e)[i]);
    });
    unsure.clear();
    for (std::size_t t = 0; t < home.size(); ++t)
      if (grows(home[t].ellipsoid)) unsure.push_back(static_cast<Index>(t));
    if (unsure.empty()) return;
  }
}

namespace {

/// The triangles of `which` that the ellipsoid holds.
std::vector<Index> held_of(const Ellipsoid& e, const geometry::TriMesh& mesh,
                           std::span<const Index> triangles, std::span<const Index> which) {
  std::vector<Index> held;
  const LevelForm form(e);
  std::array<double, TriangleBatch::kMost> level;
  for_each_batch(mesh, triangles, which, [&](const TriangleBatch& batch, std::size_t first) {
    worst_levels(form, batch, level.data());
    for (std::size_t i = 0; i < batch.count; ++i)
      if (level[i] <= kInside) held.push_back(which[first + i]);
  });
  return held;
}

/// A small ellipsoid that holds the triangles for certain and the anchor nearly.
Ellipsoid around(const Ellipsoid& anchor, const geometry::TriMesh& mesh, std::span<const Index> triangles) {
  std::vector<Vec3> corners;
  for (const Index t : triangles)
    for (int k = 0; k < 3; ++k) corners.push_back(mesh.corner(t, k));
  Ellipsoid e = grown(anchor, corners);
  double most = 0.0;
  for (const Vec3& p : corners) most = std::max(most, geometry::level(e, p));
  if (most > kInside) e.radii *= std::sqrt(most) * (1.0 + 1e-9);
  return e;
}

}  // namespace

void relax_cover(const engine::Context& context, const geometry::TriMesh& mesh,
                 std::span<const Index> triangles, std::span<const Ellipsoid> anchors,
                 std::vector<Ellipsoid>& ellipsoids) {
  constexpr int kRounds = 3;
  const std::vector<Index> all = all_of(triangles);
  // Triangles that an ellipsoid holds anew after it shrank are not counted, which errs on the safe side.
  std::vector<std::vector<Index>> held(ellipsoids.size());
  engine::parallel_for(context, held.size(), 1, [&](std::size_t e, std::size_t) {
    held[e] = held_of(ellipsoids[e], mesh, triangles, all);
  });
  std::vector<std::uint32_t> holders(triangles.size(), 0);
  for (const auto& mine : held)
    for (const Index t : mine) ++holders[t];
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t e = 0; e < ellipsoids.size(); ++e) {
      context.checkpoint();
      std::vector<Index> alone;
      for (const Index t : held[e])
        if (holders[t] == 1) alone.push_back(triangles[t]);
      const Ellipsoid smaller = around(anchors[e], mesh, alone);
      if (!(geometry::volume(smaller) < geometry::volume(ellipsoids[e]))) continue;
      for (const Index t : held[e]) --holders[t];
      ellipsoids[e] = smaller;
      held[e] = held_of(smaller, mesh, triangles, held[e]);
      for (const Index t : held[e]) ++holders[t];
    }
}

}  // namespace bodice::fitting
