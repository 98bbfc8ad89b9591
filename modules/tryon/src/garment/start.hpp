// The start of a garment that was made for the skin, where the proxy is wider than the skin.
#pragma once

#include <bodice/cloth/solver.hpp>
#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::inline v0_1::tryon {

/// Moves vertices that begin inside the proxy, or nearer than `thickness_m`, out along the normal of the skin
/// below them, in the solver and in the wardrobe; returns the farthest move, meters. Neighbors move alike,
/// whereas the closest exits from many ellipsoids differ, which would tear and tangle the cloth. Vertices
/// without an exit of 0.2 m stay where they are. Nothing moves if none is deeper than 15 mm, as on proxies of
/// the tiers tight and relief. Cost: a closest point of the skin and some queries a vertex.
double lift_out(const engine::Context& context, const SegmentedSkin& skin,
                const collision::Collider& collider, double thickness_m, Wardrobe& wardrobe,
                cloth::Solver& solver);

}  // namespace bodice::tryon
