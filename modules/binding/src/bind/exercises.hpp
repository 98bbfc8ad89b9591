// Poses that ask of the joints what a seat, a squat, a run and raised arms do, and what binding learns there:
// which texels have to yield more than by their burial at rest.
#pragma once

#include <span>
#include <vector>

#include "bind/bends.hpp"
#include "bind/burial.hpp"

namespace bodice::inline v0_1::binding {

/// Skinning matrices of the exercises, #J each; less than all of them where limbs are bent already, or none.
std::vector<std::vector<rig::Affine>> exercises(const SkinnedBody& body, std::span<const body::Part> part);

/// Raises the burial of buried texels that come out through the skin in an exercise, by how far they do: then
/// the ellipsoids that are the skin there own the points above it. Deterministic, parallel.
void raise_burial(const engine::Context& context, const proxy::BodyProxy& proxy,
                  const proxy::Binding& binding, const SkinnedBody& body,
                  std::span<const std::vector<rig::Affine>> exercises, Burial& burial);

}  // namespace bodice::binding
