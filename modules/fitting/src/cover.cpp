#include "cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/mvee.hpp>

#include "mvee_finish.hpp"

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;

constexpr int kPasses = 4;
constexpr double kInside = 1.0 - 1e-12;  // levels below this stay inside under rounding of the stored radii

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

/// Levels of the mesh's vertices that the triangles use, one row an ellipsoid.
struct Levels {
  std::vector<Index> used;    ///< vertices, ascending
  std::vector<Index> corner;  ///< 3 #T, into used
  std::vector<double> level;  ///< #E x #used

  Levels(const geometry::TriMesh& mesh, std::span<const Index> triangles) {
    for (const Index t : triangles)
      used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<Index> place(mesh.positions.size());
    for (std::size_t i = 0; i < used.size(); ++i) place[used[i]] = static_cast<Index>(i);
    for (const Index t : triangles)
      for (const Index v : mesh.triangles[t]) corner.push_back(place[v]);
  }

  void measure(const engine::Context& context, const geometry::TriMesh& mesh,
               const std::vector<Ellipsoid>& ellipsoids, std::span<const std::size_t> which) {
    level.resize(ellipsoids.size() * used.size());
    engine::parallel_for(context, which.size(), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const Ellipsoid& e = ellipsoids[which[n]];
        const geometry::Mat3 whiten = e.radii.cwiseInverse().asDiagonal() * e.axes.transpose();
        double* const row = &level[which[n] * used.size()];
        for (std::size_t i = 0; i < used.size(); ++i)
          row[i] = (whiten * (mesh.positions[used[i]] - e.center)).squaredNorm();
      }
    });
  }

  double worst(std::size_t e, std::size_t t) const {
    const double* const row = &level[e * used.size()];
    return std::max({row[corner[3 * t]], row[corner[3 * t + 1]], row[corner[3 * t + 2]]});
  }
};

constexpr std::size_t kCovered = std::numeric_limits<std::size_t>::max();

/// For each triangle that no ellipsoid holds whole: the one that has to grow least for it, by the length of
/// ray outside it. Others: kCovered.
std::vector<std::size_t> homes(const engine::Context& context, const geometry::TriMesh& mesh,
                               std::span<const Index> triangles, const Levels& levels,
                               const std::vector<Ellipsoid>& ellipsoids) {
  std::vector<std::size_t> home(triangles.size(), kCovered);
  engine::parallel_for(context, triangles.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      double least = std::numeric_limits<double>::infinity();
      std::size_t best = 0;
      for (std::size_t e = 0; e < ellipsoids.size(); ++e) {
        const double level = levels.worst(e, t);
        if (level <= kInside) {
          best = kCovered;
          break;
        }
        const double ray = (mesh.corner(triangles[t], 0) - ellipsoids[e].center).norm();
        const double outside = ray * (1.0 - 1.0 / std::sqrt(level));
        if (outside < least) least = outside, best = e;
      }
      home[t] = best;
    }
  });
  return home;
}

}  // namespace

Ellipsoid grown(const Ellipsoid& ellipsoid, std::span<const Vec3> points) {
  static constexpr double kVolumeTolerance = 1e-4;
  std::vector<Vec3> all(points.begin(), points.end());
  for (const Vec3& u : icosahedron())
    all.push_back(ellipsoid.center + ellipsoid.axes * ellipsoid.radii.cwiseProduct(u));
  return mvee(all, {kVolumeTolerance, ellipsoid.radii.minCoeff()}).ellipsoid;
}

Ellipsoid stretched(const Ellipsoid& e, const Vec3& point) {
  constexpr double kSlack = 1.0 + 1e-9;  // over the rounding of the new axes
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
  Levels levels(mesh, triangles);
  std::vector<std::size_t> changed(ellipsoids.size());
  for (std::size_t e = 0; e < changed.size(); ++e) changed[e] = e;
  for (int pass = 0; pass <= kPasses; ++pass) {
    levels.measure(context, mesh, ellipsoids, changed);
    const auto home = homes(context, mesh, triangles, levels, ellipsoids);
    std::vector<std::vector<Vec3>> extra(ellipsoids.size());
    for (std::size_t t = 0; t < home.size(); ++t) {
      if (home[t] == kCovered) continue;
      for (int k = 0; k < 3; ++k) extra[home[t]].push_back(mesh.corner(triangles[t], k));
    }
    changed.clear();
    for (std::size_t e = 0; e < extra.size(); ++e)
      if (!extra[e].empty()) changed.push_back(e);
    if (changed.empty()) return;
    // Growing is not nested: a new ellipsoid may let go of what the old one held. Stretching is.
    const bool last = pass == kPasses;
    engine::parallel_for(context, changed.size(), 1, [&](std::size_t n, std::size_t) {
      const std::size_t e = changed[n];
      if (!last) ellipsoids[e] = grown(ellipsoids[e], extra[e]);
      for (std::size_t i = 0; last && i < extra[e].size(); ++i)
        ellipsoids[e] = stretched(ellipsoids[e], extra[e][i]);
    });
  }
}

namespace {

/// As little around the anchor and the triangles as growing finds, surely holding the triangles.
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
  Levels levels(mesh, triangles);
  std::vector<std::size_t> all(ellipsoids.size());
  for (std::size_t e = 0; e < all.size(); ++e) all[e] = e;
  levels.measure(context, mesh, ellipsoids, all);
  std::vector<int> holders(triangles.size(), 0);
  const auto count = [&](std::size_t e, int by) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (levels.worst(e, t) <= kInside) holders[t] += by;
  };
  for (const std::size_t e : all) count(e, 1);
  for (int round = 0; round < kRounds; ++round)
    for (const std::size_t e : all) {
      context.checkpoint();
      std::vector<Index> alone;
      for (std::size_t t = 0; t < triangles.size(); ++t)
        if (holders[t] == 1 && levels.worst(e, t) <= kInside) alone.push_back(triangles[t]);
      const Ellipsoid smaller = around(anchors[e], mesh, alone);
      if (!(geometry::volume(smaller) < geometry::volume(ellipsoids[e]))) continue;
      count(e, -1);
      ellipsoids[e] = smaller;
      levels.measure(context, mesh, ellipsoids, std::span(&e, 1));
      count(e, 1);
    }
}

}  // namespace bodice::fitting
