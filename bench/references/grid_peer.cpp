#include <algorithm>
#include <cmath>

#include <bench_references/peers.hpp>
#include <bench_support/stopwatch.hpp>

namespace bench {

using bodice::geometry::Vec3;

namespace {

constexpr double kPad_m = 0.06;

struct Grid {
  Vec3 low;
  float inverse_cell;
  int n[3];
  std::vector<float> value;

  float corner(int i, int j, int k) const {
    return value[(static_cast<std::size_t>(k) * static_cast<std::size_t>(n[1]) +
                  static_cast<std::size_t>(j)) *
                     static_cast<std::size_t>(n[0]) +
                 static_cast<std::size_t>(i)];
  }
};

Grid empty_grid(const bodice::geometry::Box& box, double cell_m) {
  Grid grid;
  grid.low = box.low - Vec3::Constant(kPad_m);
  grid.inverse_cell = static_cast<float>(1.0 / cell_m);
  std::size_t total = 1;
  for (int axis = 0; axis < 3; ++axis) {
    grid.n[axis] = static_cast<int>((box.size()[axis] + 2.0 * kPad_m) / cell_m) + 2;
    total *= static_cast<std::size_t>(grid.n[axis]);
  }
  grid.value.resize(total);
  return grid;
}

/// Fills in exact values near the skin; farther out than twice the pad a neighbor's value is good enough for
/// the rows.
void fill(Grid& grid, const bodice::geometry::MeshDistance& skin, double cell_m) {
  std::size_t at = 0;
  for (int k = 0; k < grid.n[2]; ++k)
    for (int j = 0; j < grid.n[1]; ++j) {
      double known = 0.0;
      for (int i = 0; i < grid.n[0]; ++i, ++at) {
        // The distance changes by at most a cell a step, so that steps are skipped where it is large.
        known -= cell_m;
        if (known < 2.0 * kPad_m || i == 0) {
          const double d = skin.signed_distance(grid.low + cell_m * Vec3(i, j, k));
          grid.value[at] = static_cast<float>(d);
          known = std::abs(d);
        } else {
          grid.value[at] = grid.value[at - 1];
        }
      }
    }
}

float sample(const Grid& g, float x, float y, float z) {
  const float u = std::clamp(x * g.inverse_cell, 0.0f, static_cast<float>(g.n[0] - 2));
  const float v = std::clamp(y * g.inverse_cell, 0.0f, static_cast<float>(g.n[1] - 2));
  const float w = std::clamp(z * g.inverse_cell, 0.0f, static_cast<float>(g.n[2] - 2));
  const int i = static_cast<int>(u), j = static_cast<int>(v), k = static_cast<int>(w);
  const float a = u - static_cast<float>(i), b = v - static_cast<float>(j), c = w - static_cast<float>(k);
  const auto row = [&](int dj, int dk) {
    const float left = g.corner(i, j + dj, k + dk);
    return left + a * (g.corner(i + 1, j + dj, k + dk) - left);
  };
  const float front = row(0, 0) + b * (row(1, 0) - row(0, 0));
  const float back = row(0, 1) + b * (row(1, 1) - row(0, 1));
  return front + c * (back - front);
}

}  // namespace

Peer grid_peer(const bodice::geometry::TriMesh& mesh, const bodice::geometry::MeshDistance& skin,
               double cell_m) {
  auto grid = std::make_shared<Grid>(empty_grid(bodice::geometry::bounding_box(mesh.positions), cell_m));
  const Stopwatch watch;
  fill(*grid, skin, cell_m);
  Peer peer;
  peer.build_ms = watch.cpu_ms();
  peer.name = "dense distance grid, " + std::to_string(static_cast<int>(std::lround(1e3 * cell_m))) + " mm";
  peer.bytes = 4.0 * static_cast<double>(grid->value.size());
  peer.query = [grid](const Cloud& cloud, std::span<float> distance_m) {
    const auto x0 = static_cast<float>(grid->low.x()), y0 = static_cast<float>(grid->low.y()),
               z0 = static_cast<float>(grid->low.z());
    for (std::size_t i = 0; i < cloud.size(); ++i)
      distance_m[i] = sample(*grid, cloud.x[i] - x0, cloud.y[i] - y0, cloud.z[i] - z0);
  };
  return peer;
}

}  // namespace bench
