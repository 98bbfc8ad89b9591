// Coarse levels: the body supports the nodes that touch it, so that a few light particles carry many.
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "constraints/coarse.hpp"
#include "fixtures.hpp"
#include "solver/state.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

/// A strip of 4 x 96 quads of 1 cm along z, stretched to one and a half of its length. Its first 20 cm touch
/// a body with this normal.
struct StretchedStrip {
  explicit StretchedStrip(const Vec3& normal) {
    auto made = cloth::make_state(sheet(4, 96, 0.04, 0.96, Vec3::Zero()), {}, cotton(), vacuum());
    REQUIRE(made.ok());
    state = std::move(*made);
    cloth::Particles& p = state.particles;
    for (std::size_t i = 0; i < p.count(); ++i) {
      touching.push_back(p.point[i].z < 0.2f);
      p.point[i].z *= 1.5f;
      normals.push_back({static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                         static_cast<float>(normal.z()), 0.0f});
    }
  }

  void solve(float friction, std::span<const float> friction_share = {}) {
    cloth::solve_coarse({}, {touching, normals, friction_share, friction}, state.coarse, state.particles);
  }

  /// Calls visit with the displacement of each node of the coarsest level and whether it touches.
  template <class Visit>
  void for_each_node(const Visit& visit) const {
    const cloth::CoarseLevel& level = state.coarse.front();
    for (std::size_t n = 0; n < level.node.size(); ++n)
      visit(Vec3(level.move[n].x, level.move[n].y, level.move[n].z), touching[level.node[n]] != 0);
  }

  /// The mean displacement along z of what hangs, meters.
  double hanging_z_m() const {
    double sum = 0.0;
    int count = 0;
    for_each_node([&](const Vec3& displacement, bool touches) {
      if (!touches) sum += displacement.z(), ++count;
    });
    return sum / count;
  }

  cloth::State state;
  std::vector<std::uint8_t> touching;
  std::vector<cloth::Point> normals;
};

/// Two square panels of 40 cm on either side of a bar along x, and a strap of 3 cm over it that joins them.
/// Its middle begins 3 cm above the bar.
TriMesh panels_on_a_strap(double edge_m, double bar_radius_m) {
  const int columns = static_cast<int>(std::lround(0.4 / edge_m)), rows = 3 * columns;
  const int half_strap = static_cast<int>(std::lround(0.015 / edge_m));
  const int first = columns / 2 - half_strap;
  const auto is_cloth = [&](int row, int column) {
    return row <= columns || row >= 2 * columns || (column >= first && column <= first + 2 * half_strap);
  };
  TriMesh mesh;
  std::vector<std::vector<Index>> at(rows + 1, std::vector<Index>(columns + 1, geometry::kNoIndex));
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      if (!is_cloth(row, column)) continue;
      at[row][column] = static_cast<Index>(mesh.positions.size());
      const double along = (row - 0.5 * rows) * edge_m, half_turn = 0.5 * std::numbers::pi * bar_radius_m;
      const double angle = std::clamp(along, -half_turn, half_turn) / bar_radius_m;
      const double hangs = std::max(0.0, std::abs(along) - half_turn);
      mesh.positions.emplace_back((column - 0.5 * columns) * edge_m,
                                  0.03 + bar_radius_m * std::cos(angle) - hangs,
                                  bar_radius_m * std::sin(angle));
    }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Index a = at[row][column], b = at[row][column + 1], c = at[row + 1][column],
                  d = at[row + 1][column + 1];
      if (std::max({a, b, c, d}) == geometry::kNoIndex) continue;
      if ((row + column) % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {{a, c, d}, {a, d, b}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
    }
  return mesh;
}

}  // namespace

TEST_CASE("coarse levels: no node is pulled into the body that it touches, and what hangs follows it") {
  StretchedStrip supported(Vec3(0, 0, -1));  // ties pull along z, into the body
  supported.solve(0.0f);
  supported.for_each_node([](const Vec3& displacement, bool touches) {
    if (touches) CHECK(displacement.z() <= 1e-6);
  });
  StretchedStrip free(Vec3(0, 0, -1));
  std::ranges::fill(free.touching, std::uint8_t{0});
  free.solve(0.0f);
  CHECK(supported.hanging_z_m() < free.hanging_z_m() - 0.01);
}

TEST_CASE("coarse levels: friction holds nodes that ties press on the body and pull along it") {
  const auto largest_slip_m = [](float friction, std::optional<float> share = {}) {
    StretchedStrip strip(Vec3(0, std::sqrt(0.75), -0.5));  // 60 degrees from the pull
    strip.solve(friction, share ? std::vector(strip.touching.size(), *share) : std::vector<float>());
    const Vec3 along(0, 0.5, std::sqrt(0.75));
    double slip_m = 0.0;
    strip.for_each_node([&](const Vec3& displacement, bool touches) {
      if (touches) slip_m = std::max(slip_m, displacement.dot(along));
    });
    return slip_m;
  };
  const double without = largest_slip_m(0.0f), with = largest_slip_m(0.5f);
  CHECK(without > 0.1);
  CHECK(with < 0.8 * without);
  // The coefficient exceeds the tangent of 60 degrees. What is left are nodes that are also pulled sideways.
  CHECK(largest_slip_m(2.0f) < 0.05 * without);
  CHECK(largest_slip_m(1.0f, 0.5f) == with);  // stretched cloth has a share of its friction
}

TEST_CASE("coarse levels: a strap over a bar carries two panels of many more particles") {
  constexpr double kBar_m = 0.06, kEdge_m = 0.0045;
  const TriMesh mesh = panels_on_a_strap(kEdge_m, kBar_m);
  const collision::Collider bar = ellipsoid_body(Vec3::Zero(), Vec3(1.0, kBar_m - 0.004, kBar_m - 0.004));
  cloth::SolverOptions options;
  options.self_collision = false;
  options.thickness_m = 0.002;
  cloth::Solver solver = make_solver(mesh, {}, cotton(), options);
  double longest = 0.0, lowest_m = 0.0;
  for (int frame = 0; frame < 120; ++frame)
    longest = std::max(longest, solver.step({}, bar, kFrame_s).stretch_max);
  for (const Vec3& p : positions(solver, mesh.positions.size())) lowest_m = std::min(lowest_m, p.y());
  // Eight substeps of one sweep let one edge become 2.4 times as long as it is at rest. Without support by
  // the body it is 11 times, and 20 with ties between the nearest nodes alone.
  CHECK(longest < 2.0);
  CHECK(lowest_m > -0.65);
}
