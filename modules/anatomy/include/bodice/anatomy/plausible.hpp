// The last gate: whether what was found is a human body at all.
#pragma once

#include <string>
#include <vector>

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// What of an analyzed skin contradicts a human body of any age, build and pose, a clause each, such as "its
/// skin has 2.1 times the area of a body of that stature"; empty where nothing does. None of it takes part in
/// the analysis, so that it agrees only where the analysis is right. O(#F).
std::vector<std::string> contradictions(const geometry::TriMesh& skin, const Anatomy& anatomy);

}  // namespace bodice::anatomy
