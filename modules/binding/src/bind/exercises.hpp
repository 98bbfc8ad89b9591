// Exercises: poses with the joint angles of sitting, squatting, running and raised arms. In these, binding
// finds the texels that have to yield by more than their burial at rest.
#pragma once

#include <span>
#include <vector>

#include "bind/bends.hpp"
#include "bind/burial.hpp"

namespace bodice::inline v0_1::binding {

/// Returns the skinning matrices of the exercises, #J each. Fewer or none are returned if limbs are bent
/// already.
std::vector<std::vector<rig::Affine>> exercises(const SkinnedBody& body, std::span<const body::Part> part);

/// Raises the burial of buried texels that come out through the skin in an exercise, by how far they do: then
/// the ellipsoids that are the skin there own the points above it. Deterministic, parallel.
void raise_burial(const engine::Context& context, const proxy::BodyProxy& proxy,
                  const proxy::Binding& binding, const SkinnedBody& body,
                  std::span<const std::vector<rig::Affine>> exercises, Burial& burial);

}  // namespace bodice::binding
