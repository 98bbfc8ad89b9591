// Searches for the groups of leaves that may come near each other, on the paths that are expected of them.
#pragma once

#include <span>

#include "selfcontact/self_contact.hpp"

namespace bodice::inline v0_1::cloth {

/// Lists groups anew where those of the last search do not cover particles at `at`, which may deviate from
/// their expected paths by the share `allowed` of the spare distance. A search also finds the triangles that
/// cross, unless they are known.
void update_groups(const engine::Context& context, const SelfSubstep& substep, std::span<const Point> at,
                   float allowed, SelfContact& self);

}  // namespace bodice::cloth
