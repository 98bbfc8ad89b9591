#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Analyzes a skin as it is.
using Analyze = engine::Result<Anatomy> (*)(const engine::Context& context, const geometry::TriMesh& mesh,
                                            const Options& options);

/// The result of `analyze` on a skin. Where limbs are welded to the trunk or to each other, it is the result
/// on a thin copy on which they are apart, with the warning "limbs-cut". Fails as `analyze` does. Cost: that
/// of `analyze`; with signs of a weld, several times as much.
engine::Result<Anatomy> cut_welds(const engine::Context& context, const geometry::TriMesh& mesh,
                                  const Options& options, Analyze analyze);

}  // namespace bodice::anatomy
