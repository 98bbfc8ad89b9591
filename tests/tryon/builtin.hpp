// The built-in body as several cases look at it: made, segmented and fitted once a program. It is const, and
// so no case depends on another.
#pragma once

#include <bodice/tryon/prepare.hpp>

/// The built-in body of about this number of vertices, in parts.
const bodice::tryon::SegmentedSkin& builtin_skin(int vertices);

/// The same with its proxy in a tier.
const bodice::tryon::PreparedBody& builtin_body(int vertices, bodice::proxy::Tier tier);

/// The same with a rig, to which its proxy is bound; made anew by the workers of a context, or once a
/// program.
bodice::tryon::PreparedBody make_bound_builtin_body(const bodice::engine::Context& context, int vertices,
                                                    bodice::proxy::Tier tier);
const bodice::tryon::PreparedBody& bound_builtin_body(int vertices, bodice::proxy::Tier tier);
