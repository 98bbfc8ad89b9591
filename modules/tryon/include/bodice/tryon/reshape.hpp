// The same body in another shape, as after a slider of girth or weight.
#pragma once

#include <memory>
#include <span>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// A skin in another shape and its proxy.
struct ReshapedBody {
  std::shared_ptr<const SegmentedSkin> skin;
  proxy::BodyProxy proxy;
};

/// Whether positions are a shape of this skin: one for each vertex, and finite. Fails with kInvalidArgument.
engine::Result<void> check_shape(const SegmentedSkin& skin, std::span<const geometry::Vec3> positions);

/// Carries a proxy to another shape of its skin; `positions` are those of the skin's vertices (#V). The
/// affine map that fits the motion of its skin best carries each ellipsoid. Tables are solved anew from the
/// present ones. Joints move with the skin around them. A bound proxy is bound anew, without its base poses.
/// Parts and landmarks stay with their vertices. Fails with kInvalidArgument for another number of positions
/// or ones that are not finite, with kUnusableGeometry where a shape has no stature, and with kCanceled. The
/// same bits for any number of workers. Takes some .3 s of one core, .5 s with a binding.
engine::Result<ReshapedBody> reshape_body(const engine::Context& context, const SegmentedSkin& skin,
                                          const proxy::BodyProxy& proxy,
                                          std::span<const geometry::Vec3> positions);

}  // namespace bodice::tryon
