#pragma once

#include <span>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/proxy/posed_proxy.hpp>

namespace bodice::inline v0_1::tryon {

inline constexpr double kDeep_m = 0.001;  ///< the depth of "deeper than 1 mm" in reports

/// The depth of cloth inside the true skin.
struct Penetration {
  double deepest_m = 0.0;    ///< 0 when nothing is inside
  std::size_t over_1mm = 0;  ///< particles deeper than kDeep_m
};

/// Measures each particle's exact signed distance to the skin; positions that are not finite are skipped. The
/// result does not depend on the number of workers. Cost: one signed distance a particle, a few microseconds.
Penetration penetration(const engine::Context& context, const geometry::MeshDistance& skin,
                        std::span<const geometry::Vec3> positions);

/// Counts the particles (#P, meters) inside the proxy, deeper than the rounding of float positions, or with
/// relief than the error that a collider certifies. It checks the result of a response independently: it
/// evaluates proxy::proxy_distance() in double precision, not the collider that moved the particles.
/// Positions that are not finite are skipped. Cost: one proxy distance a particle, some microseconds.
std::size_t count_inside(const engine::Context& context, const proxy::BodyProxy& proxy,
                         std::span<const geometry::Vec3> positions);

/// The same for a bound proxy in a pose, by proxy::posed_proxy_distance().
std::size_t count_inside(const engine::Context& context, const proxy::BodyProxy& bound,
                         const proxy::PosedProxy& posed, std::span<const geometry::Vec3> positions);

/// The share of the cloth's area that lies inside the skin, by the centroids of triangles. It may be above
/// zero although every particle is outside. Cost: one signed distance a triangle.
double pierced_share(const engine::Context& context, const geometry::MeshDistance& skin,
                     std::span<const geometry::Vec3> positions,
                     std::span<const geometry::Triangle> triangles);

}  // namespace bodice::tryon
