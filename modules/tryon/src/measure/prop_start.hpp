#pragma once

#include <span>

#include <bodice/tryon/drape.hpp>

namespace bodice::inline v0_1::tryon {

/// Fails with kUnusableGeometry where a garment begins more than 5 mm inside a prop. Cloth through a seat
/// could not be pushed out of it without being torn.
engine::Result<void> check_start(const engine::Context& context, std::span<const geometry::Vec3> positions,
                                 std::span<const PreparedBody> props);

/// Checks the start, joins the props to the body's proxy, and writes the joint proxy and the props' reports
/// to `result`.
engine::Result<void> join_props(const engine::Context& context, std::span<const geometry::Vec3> positions,
                                const PreparedBody& body, std::span<const PreparedBody> props,
                                DrapeResult& result);

}  // namespace bodice::tryon
