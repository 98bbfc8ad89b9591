#include <bodice/tryon/reach.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/proxy/proxy_distance.hpp>

#include "garment/check_garment.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;
using proxy::BodyProxy;

/// The bounding ball of a triangle around its centroid. A point within a distance d of the triangle is within
/// d plus the radius of the center.
struct Ball {
  Vec3 center;
  double radius_m;
};

Ball ball_of(const geometry::TriMesh& mesh, std::size_t triangle) {
  const Vec3 a = mesh.corner(triangle, 0), b = mesh.corner(triangle, 1), c = mesh.corner(triangle, 2);
  const Vec3 middle = (a + b + c) / 3.0;
  return {middle, std::sqrt(std::max(
                      {(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()}))};
}

std::vector<Ball> balls_of(std::span<const geometry::TriMesh> garments) {
  std::vector<Ball> balls;
  for (const geometry::TriMesh& mesh : garments)
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (const Ball ball = ball_of(mesh, t); ball.center.allFinite()) balls.push_back(ball);
  return balls;
}

engine::Result<void> check_reach(std::span<const geometry::TriMesh> garments, double margin_m) {
  if (!(margin_m >= 0.0) || !std::isfinite(margin_m))
    return engine::Error{engine::ErrorCode::kInvalidArgument, "The margin of a garment's reach is no length.",
                         "Give meters, zero or more."};
  return check_triangles(garments);
}

/// Whether the ellipsoid is within reach. It may be true as well for one that is too far by the size of a
/// triangle.
bool reaches(const geometry::Ellipsoid& shape, const std::vector<Ball>& balls, double within_m) {
  const double largest_m = shape.radii.maxCoeff();
  return std::ranges::any_of(balls, [&](const Ball& ball) {
    const double reach_m = within_m + ball.radius_m;
    if ((ball.center - shape.center).norm() > largest_m + reach_m) return false;
    return geometry::closest_point(shape, ball.center).signed_distance <= reach_m;
  });
}

BodyProxy::Data cropped_data(const BodyProxy& whole, const std::vector<std::uint8_t>& kept) {
  BodyProxy::Data data{.tier = whole.tier(),
                       .stature_m = whole.stature_m(),
                       .margin_m = whole.margin_m(),
                       .source_hash = whole.source_hash(),
                       .frame = whole.frame()};
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (!kept[k]) continue;
    data.ellipsoids.push_back(whole.ellipsoids()[k]);
    if (whole.relief().empty()) continue;
    proxy::ReliefTable table = whole.relief()[k];
    const auto texels = whole.texels().subspan(
        table.first_texel, static_cast<std::size_t>(table.nodes_per_side) * table.nodes_per_side);
    table.first_texel = static_cast<std::uint32_t>(data.texels.size());
    data.texels.insert(data.texels.end(), texels.begin(), texels.end());
    data.relief.push_back(table);
  }
  return data;
}

/// The parts of the triangle's corners as a bit set.
std::uint32_t parts_of(const SegmentedSkin& skin, std::size_t triangle) {
  std::uint32_t bits = 0;
  for (const geometry::Index v : skin.input.skin.triangles[triangle])
    bits |= 1u << static_cast<int>(skin.anatomy.part[v]);
  return bits;
}

}  // namespace

engine::Result<std::uint32_t> reachable_parts(const engine::Context& context, const SegmentedSkin& skin,
                                              std::span<const geometry::TriMesh> garments, double margin_m) {
  if (auto good = check_reach(garments, margin_m); !good) return std::move(good).error();
  return engine::catch_canceled("The search for parts within reach", [&]() -> engine::Result<std::uint32_t> {
    const geometry::TriMesh& mesh = skin.input.skin;
    std::atomic<std::uint32_t> reached = 0;  // a union of bits, so that the order of writing does not matter
    for (const geometry::TriMesh& garment : garments) {
      const geometry::MeshDistance to_garment(context, garment);
      engine::parallel_for(context, mesh.triangles.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
          const std::uint32_t bits = parts_of(skin, t);
          if ((reached.load(std::memory_order_relaxed) & bits) == bits) continue;
          const Ball ball = ball_of(mesh, t);
          if (to_garment.closest_point_within(ball.center, margin_m + ball.radius_m)) reached.fetch_or(bits);
        }
      });
    }
    return reached.load();
  });
}

engine::Result<BodyProxy> within_reach(const engine::Context& context, const BodyProxy& proxy,
                                       std::span<const geometry::TriMesh> garments, double margin_m) {
  if (auto good = check_reach(garments, margin_m); !good) return std::move(good).error();
  // An ellipsoid contributes beyond its own distance, as long as it is blended with the closest one.
  const double blend_m = proxy.relief().empty() ? 0.0 : proxy::relief_reach(proxy.stature_m()).blend_m;
  const std::vector<Ball> balls = balls_of(garments);
  std::vector<std::uint8_t> kept(proxy.ellipsoids().size());
  const auto searched = engine::catch_canceled("The search for what is within reach", [&] {
    engine::parallel_for(context, kept.size(), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        kept[k] = reaches(proxy.ellipsoids()[k].shape, balls, margin_m + blend_m);
    });
    return engine::Result<void>();
  });
  if (!searched) return searched.error();
  if (std::ranges::none_of(kept, [](std::uint8_t flag) { return flag != 0; }))
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "Nothing of the proxy is within reach of the garments.",
                         "Check that they have the same origin and units, or raise the margin."};
  return BodyProxy::make(cropped_data(proxy, kept));
}

}  // namespace bodice::tryon
