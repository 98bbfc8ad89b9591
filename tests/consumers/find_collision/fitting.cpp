// A tool with skins and labels of its own: it links fitting alone, and fits a proxy to a ball.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <bodice/fitting/fit.hpp>

int main() {
  using namespace bodice;
  constexpr std::size_t kRound = 40, kRows = 19;
  constexpr double kRadius_m = 0.4;
  geometry::TriMesh ball;
  for (std::size_t row = 1; row <= kRows; ++row)
    for (std::size_t i = 0; i < kRound; ++i) {
      const double polar = std::numbers::pi * static_cast<double>(row) / (kRows + 1);
      const double around = 2 * std::numbers::pi * static_cast<double>(i) / kRound;
      ball.positions.emplace_back(kRadius_m * std::sin(polar) * std::cos(around), kRadius_m * std::cos(polar),
                                  -kRadius_m * std::sin(polar) * std::sin(around));
    }
  ball.positions.emplace_back(0, kRadius_m, 0);
  ball.positions.emplace_back(0, -kRadius_m, 0);
  const auto vertex = [](std::size_t row, std::size_t i) {
    return static_cast<std::uint32_t>(row * kRound + i % kRound);
  };
  for (std::size_t i = 0; i < kRound; ++i) {
    for (std::size_t row = 0; row + 1 < kRows; ++row) {
      ball.triangles.push_back({vertex(row, i), vertex(row + 1, i), vertex(row + 1, i + 1)});
      ball.triangles.push_back({vertex(row, i), vertex(row + 1, i + 1), vertex(row, i + 1)});
    }
    ball.triangles.push_back({vertex(kRows, 0), vertex(0, i), vertex(0, i + 1)});
    ball.triangles.push_back({vertex(kRows, 1), vertex(kRows - 1, i + 1), vertex(kRows - 1, i)});
  }
  const std::vector<body::Part> part(ball.positions.size(), body::Part::kHead);
  const auto fit = fitting::fit({}, {.mesh = ball, .part = part, .stature_m = 2 * kRadius_m},
                                {.tier = proxy::Tier::kTight, .max_ellipsoids = 8});
  if (!fit) return std::puts(fit.error().sentence().c_str()), 1;
  std::printf("%zu ellipsoids, %.1f mm from the ball on average\n", fit->proxy.ellipsoids().size(),
              fit->accuracy.gap_m.mean * 1e3);
  return fit->accuracy.gap_m.mean < 0.002 ? 0 : 1;
}
