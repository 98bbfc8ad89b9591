#include <bodice/tryon/fit_map.hpp>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <bodice/engine/parallel.hpp>

#include "measure/triangle_strain.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;
using Color = std::array<float, 3>;

constexpr std::size_t kVertexGrain = 256;  // about a millisecond of distances

constexpr std::array<Color, 5> kRamp = {{{0.10f, 0.25f, 0.55f},
                                         {0.52f, 0.76f, 0.88f},
                                         {0.97f, 0.94f, 0.70f},
                                         {0.91f, 0.50f, 0.22f},
                                         {0.56f, 0.06f, 0.14f}}};

/// The color at a share between loose and tight.
Color color_at(double share) {
  const double last = static_cast<double>(kRamp.size() - 1);
  const double at = last * std::clamp(std::isfinite(share) ? share : 0.0, 0.0, 1.0);
  const auto below = std::min(static_cast<std::size_t>(at), kRamp.size() - 2);
  const float mix = static_cast<float>(at - static_cast<double>(below));
  Color color{};
  for (std::size_t k = 0; k < 3; ++k)
    color[k] = std::clamp((1.0f - mix) * kRamp[below][k] + mix * kRamp[below + 1][k], 0.0f, 1.0f);
  return color;
}

}  // namespace

std::vector<double> ease_of_vertices(const engine::Context& context, const geometry::MeshDistance& skin,
                                     std::span<const Vec3> now) {
  std::vector<double> ease(now.size(), 0.0);
  engine::parallel_for(context, now.size(), kVertexGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      if (now[v].allFinite()) ease[v] = skin.signed_distance(now[v]);
  });
  return ease;
}

std::vector<double> strain_of_vertices(const geometry::TriMesh& rest, std::span<const Vec3> now) {
  std::vector<double> strain(now.size(), 0.0), area(now.size(), 0.0);
  for (const geometry::Triangle& t : rest.triangles) {
    const Vec3 &a = rest.positions[t[0]], &b = rest.positions[t[1]], &c = rest.positions[t[2]];
    const double own_m2 = 0.5 * (b - a).cross(c - a).norm(), own = longest_strain(rest, now, t);
    if (!std::isfinite(own)) continue;
    for (const geometry::Index v : t) strain[v] += own_m2 * own, area[v] += own_m2;
  }
  for (std::size_t v = 0; v < now.size(); ++v)
    if (area[v] > 0.0) strain[v] /= area[v];
  return strain;
}

std::vector<Color> fit_colors(std::span<const double> values, const FitScale& scale) {
  std::vector<Color> colors;
  colors.reserve(values.size());
  for (const double value : values)
    colors.push_back(color_at((value - scale.loose) / (scale.tight - scale.loose)));
  return colors;
}

io::Legend legend_of(const FitScale& scale) {
  const bool ease = scale.map == FitMap::kEase;
  const double in_unit = ease ? 1e3 : 1e2;
  return {.colors = {kRamp.begin(), kRamp.end()},
          .least = in_unit * scale.loose,
          .most = in_unit * scale.tight,
          .unit = ease ? "mm" : "percent",
          .at_least = "loose",
          .at_most = "tight"};
}

}  // namespace bodice::tryon
