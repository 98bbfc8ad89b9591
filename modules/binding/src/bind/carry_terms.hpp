// Eq. (1) of bind.hpp: the constant matrices of each ellipsoid's affine map.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bind/owned_skin.hpp"

namespace bodice::inline v0_1::binding {

/// The terms of one ellipsoid, those of much weight first. `stature_m` scales nothing but the least lengths.
std::vector<proxy::CarryTerm> carry_terms(const geometry::Ellipsoid& shape, const SkinnedBody& body,
                                          std::span<const OwnedVertex> owned);

/// The affine map of some terms in a pose with these skinning matrices.
rig::Affine carried(std::span<const proxy::CarryTerm> terms, std::span<const rig::Affine> skinning);

/// How far the skin departs from the terms' maps in a few poses with every joint turned at random, root of
/// the mean square, meters. Deterministic. `posed` holds the skin in those poses.
struct TurnedPose {
  std::vector<rig::Affine> skinning;
  std::vector<Vec3> skin;
};
std::vector<TurnedPose> turned_poses(const engine::Context& context, const SkinnedBody& body);
double departure(std::span<const proxy::CarryTerm> terms, std::span<const TurnedPose> poses,
                 const SkinnedBody& body, std::span<const OwnedVertex> owned);

}  // namespace bodice::binding
