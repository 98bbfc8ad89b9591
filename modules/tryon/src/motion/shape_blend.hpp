// A gradual change from another shape of the same vertices to a body's own, so that no surface jumps.
#pragma once

#include <span>
#include <vector>

#include <bodice/binding/shape_offset.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::tryon {

/// Ellipsoids and skin at rest, between an earlier shape and the body's own. Only the constructor allocates.
class ShapeBlend {
 public:
  /// Starts in the body's own shape. Keeps a reference to the skin's positions, #V.
  ShapeBlend(const proxy::BodyProxy& proxy, std::span<const geometry::Vec3> skin);

  /// Starts a blend from the present shape of another one. Does nothing for another number of ellipsoids or
  /// vertices. O(#V).
  void begin(const ShapeBlend& before);
  /// Advances the blend by dt_s.
  void advance(double dt_s);

  double share() const noexcept {
    return share_;
  }  ///< the share of the earlier shape: 1 at first, 0 at the end
  std::span<const binding::ShapeOffset> offsets() const noexcept { return offsets_; }  ///< #E
  std::span<const geometry::Ellipsoid> shapes() const noexcept { return shapes_; }     ///< #E, at rest
  /// A vertex of the skin at rest.
  geometry::Vec3 skin(std::size_t vertex) const {
    return share_ > 0.0 ? geometry::Vec3(skin_[vertex] + share_ * (skin_before_[vertex] - skin_[vertex]))
                        : skin_[vertex];
  }

 private:
  void find_shapes();

  std::span<const geometry::Vec3> skin_;
  std::vector<geometry::Vec3> skin_before_;  // #V
  std::vector<geometry::Ellipsoid> own_, shapes_;
  std::vector<binding::ShapeOffset> offsets_;
  double share_ = 0.0, whole_s_ = 0.0;
};

}  // namespace bodice::tryon
