#include <bodice/tryon/error_map.hpp>

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/proxy/proxy_distance.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

constexpr double kShareBelow = 0.98, kLeastLimit_m = 1e-4;
constexpr std::array<float, 3> kOnSurface = {0.92f, 0.92f, 0.92f}, kInside = {0.13f, 0.40f, 0.80f},
                               kOutside = {0.80f, 0.20f, 0.16f};

/// Rounds the end of a scale to one digit, which is easy to read in a legend.
double to_one_digit(double value_m) {
  const double unit = std::pow(10.0, std::floor(std::log10(value_m)));
  return std::round(value_m / unit) * unit;
}

double limit_of(const std::vector<double>& error_m) {
  std::vector<double> sizes;
  for (const double e : error_m) sizes.push_back(std::abs(e));
  if (sizes.empty()) return kLeastLimit_m;
  const auto at = static_cast<std::ptrdiff_t>(kShareBelow * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, sizes.begin() + at);
  return to_one_digit(std::max(kLeastLimit_m, sizes[static_cast<std::size_t>(at)]));
}

}  // namespace

ErrorMap error_map(const engine::Context& context, const PreparedBody& body) {
  const std::vector<geometry::Vec3>& points = body.skin.input.skin.positions;
  ErrorMap map;
  map.error_m.resize(points.size());
  engine::parallel_for(context, points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      map.error_m[v] = proxy::proxy_distance(body.fit.proxy, points[v]).distance;
  });
  map.limit_m = limit_of(map.error_m);
  for (const double error : map.error_m) {
    const auto share = static_cast<float>(std::min(1.0, std::abs(error) / map.limit_m));
    const std::array<float, 3>& end = error < 0.0 ? kInside : kOutside;
    std::array<float, 3>& color = map.colors.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) color[k] = kOnSurface[k] + (end[k] - kOnSurface[k]) * share;
  }
  return map;
}

io::Legend legend_of(const ErrorMap& map) {
  return {.colors = {kInside, kOnSurface, kOutside},
          .least = -1e3 * map.limit_m,
          .most = 1e3 * map.limit_m,
          .unit = "mm",
          .at_least = "proxy outside",
          .at_most = "skin outside"};
}

}  // namespace bodice::tryon
