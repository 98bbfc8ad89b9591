#pragma once

#include <span>

#include <bodice/tryon/drape.hpp>

namespace bodice::inline v0_1::tryon {

/// Refuses garments that begin inside a prop: cloth cannot be pushed out of a seat that it passes through
/// without being torn.
engine::Result<void> check_start(const engine::Context& context, std::span<const geometry::Vec3> positions,
                                 std::span<const PreparedBody> props);

/// Checks the start and joins the props to the body's proxy, for the cloth and the report of a drape.
engine::Result<void> join_props(const engine::Context& context, std::span<const geometry::Vec3> positions,
                                const PreparedBody& body, std::span<const PreparedBody> props,
                                DrapeResult& result);

}  // namespace bodice::tryon
