#include <bodice/collision/pose_refusal.hpp>

#include <string>
#include <utility>

#include "collider/mended_ellipsoid.hpp"

namespace bodice::inline v0_1::collision {

namespace {

/// What a person finds an ellipsoid by.
std::string label_of(const proxy::BodyProxy& proxy, std::size_t k) {
  const proxy::ProxyEllipsoid& e = proxy.ellipsoids()[k];
  std::string label = std::to_string(k) + " (" + std::string(body::name(e.part));
  if (proxy.binding() && e.bone != proxy::kNoBone)
    label += ", joint '" + proxy.binding()->joint_names[static_cast<std::size_t>(e.bone)] + "'";
  return label + ")";
}

engine::Error refused(std::string message, std::string remedy) {
  return {engine::ErrorCode::kInvalidArgument, "Collider: " + std::move(message), std::move(remedy)};
}

}  // namespace

std::optional<engine::Error> why_refused(const proxy::BodyProxy& proxy,
                                         std::span<const geometry::Ellipsoid> shapes) {
  const std::size_t needed = proxy.ellipsoids().size();
  if (shapes.size() != needed)
    return refused("the pose has " + std::to_string(shapes.size()) + " ellipsoids, and the proxy " +
                       std::to_string(needed) + ".",
                   "Give one for each ellipsoid of the proxy, in its order.");
  for (std::size_t k = 0; k < needed; ++k) {
    geometry::Ellipsoid e = shapes[k];
    if (const std::string_view reason = mend(e); !reason.empty())
      return refused("ellipsoid " + label_of(proxy, k) + " " + std::string(reason) + ".",
                     "Give each ellipsoid a rotation with at most one scale, and radii above zero.");
  }
  return std::nullopt;
}

}  // namespace bodice::collision
