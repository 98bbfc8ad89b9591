// How far arms have to be held out so that they clear the body they hang beside.
#pragma once

#include <span>

#include <bodice/body/part.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/rig/rig.hpp>

namespace bodice::inline v0_1::rigging {

/// MotionOptions::arms_out_deg with which hanging arms pass hips and thighs, and with which the skin of arm
/// and trunk leaves room for two layers of cloth in the armpits: 5 for slim bodies, 16 for heavy ones, never
/// more than 30. For armpits it is never more than 16, so that those of the heaviest still press. `part` is
/// #V; the rig is bound to the skin and has the common skeleton, else the result is 0. O(#V log #V): poses
/// the skin and builds a distance tree of it seven times at most.
double clear_arms_deg(const geometry::TriMesh& skin, std::span<const body::Part> part, const rig::Rig& rig);

/// The same for a body that was another shape before, with arms that were held out so far. For armpits they
/// come nearer to clear_arms_deg() by a third of a degree, so that they do not jump; hands pass wider hips at
/// once. Builds one distance tree.
double keep_arms_clear_deg(const geometry::TriMesh& skin, std::span<const body::Part> part,
                           const rig::Rig& rig, double before_deg);

}  // namespace bodice::rigging
