// Bones of the host.
#pragma once

#include <bodice/rig/rig.hpp>

#include "base/outcome.hpp"

namespace bodice::inline v0_1::capi {

/// Copies a rig for a mesh of so many vertices; names the joint or the vertex at fault. O(#J + #weights).
Outcome read_rig(const bodice_rig* given, std::size_t vertices, rig::Rig& out);

}  // namespace bodice::capi
