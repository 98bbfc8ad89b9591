// Eq. (2) of bind.hpp: the texels that follow the skin, and the skin points at their surface.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include <bodice/geometry/mesh_distance.hpp>

#include "bind/owned_skin.hpp"

namespace bodice::inline v0_1::binding {

/// One texel near the skin.
struct SkinNode {
  std::uint16_t texel = 0;
  Vec3 position = Vec3::Zero();    ///< the skin point less the ellipsoid's center
  Vec3 direction = Vec3::UnitX();  ///< unit direction of its closest point on the ellipsoid
  double height_m = 0.0;           ///< its signed distance to the ellipsoid
  std::vector<std::pair<std::uint16_t, double>> weights;  ///< joints that move it
};

/// What the nodes of all tables are found with.
struct NodeSearch {
  const proxy::BodyProxy& proxy;
  const SkinnedBody& body;
  const geometry::MeshDistance& distance;  ///< of the skin
  double scale = 1.0;                      ///< the body's stature over the reference's
};

/// The texels of ellipsoid k's table that have the skin near their zero, if k is nearly the nearest one
/// there.
std::vector<SkinNode> find_nodes(const NodeSearch& search, std::size_t k);

/// For each texel of a table the node's texel that it takes its change from: itself, or the nearest along the
/// grid. Border texels have the neighbors that the octahedral map gives them. No node: each itself.
std::vector<std::uint16_t> find_followers(std::span<const SkinNode> nodes, int nodes_per_side);

/// Appends the nodes of the next ellipsoid to the binding, which has its terms already.
void add_nodes(std::vector<SkinNode> nodes, double longest_radius_m, int nodes_per_side,
               proxy::Binding& binding);

}  // namespace bodice::binding
