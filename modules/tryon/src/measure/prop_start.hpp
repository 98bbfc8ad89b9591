#pragma once

#include <span>

#include <bodice/tryon/prop.hpp>

namespace bodice::tryon {

/// Refuses garments that begin inside a prop: cloth cannot be pushed out of a seat that it passes through
/// without being torn.
engine::Result<void> check_start(const engine::Context& context, std::span<const geometry::Vec3> positions,
                                 std::span<const PreparedBody> props);

}  // namespace bodice::tryon
