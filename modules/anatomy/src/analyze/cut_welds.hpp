#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Analyzes a skin as it is.
using Analyze = engine::Result<Anatomy> (*)(const engine::Context& context, const geometry::TriMesh& mesh,
                                            const Options& options);

/// What `analyze` found on a skin; where limbs are welded to the trunk or to each other, what it finds on a
/// thin copy that comes apart there, with the warning "limbs-cut". Skins that show no sign of a weld are left
/// alone: they cost nothing more.
engine::Result<Anatomy> cut_welds(const engine::Context& context, const geometry::TriMesh& mesh,
                                  const Options& options, Analyze analyze);

}  // namespace bodice::anatomy
