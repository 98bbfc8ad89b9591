// The skin of a posed body without the triangles that lie inside another limb. It bounds the body, so that
// the distance to it is a depth everywhere; the distance to all skin is none next to buried triangles.
#pragma once

#include <memory>
#include <optional>

#include "skin/skin_samples.hpp"

namespace bodice::inline v0_1::fitting {

/// Distances to the skin that bounds the body.
class FreeSkin {
 public:
  /// `source` must outlive this object. O(#F log #F) if any triangle is buried, else O(#F).
  FreeSkin(const engine::Context& context, const SkinSource& source);

  /// The whole skin, with its buried triangles.
  const LabeledSkin& all() const { return source_.skin; }
  /// Whether a triangle of the whole skin bounds the body.
  bool bounds(std::size_t triangle) const { return buried_.empty() || !buried_[triangle]; }
  /// Whether no corner of the triangle is buried. A triangle that bounds the body may still dip into another
  /// limb.
  bool is_open(std::size_t triangle) const { return !source_.buried[triangle]; }
  /// Whether buried triangles were cut out, so that the skin has rims.
  bool is_cut() const { return own_ != nullptr; }
  bool wanted(body::Part part) const { return ((source_.parts >> static_cast<int>(part)) & 1u) != 0; }

  /// The closest point of the free skin within a distance; the sign of its distance has no meaning.
  std::optional<geometry::SurfacePoint> closest_point_within(const Vec3& point, double max_distance_m) const {
    return distance_->closest_point_within(point, max_distance_m);
  }
  body::Part part(const geometry::SurfacePoint& hit) const;
  bool inside(const Vec3& point) const { return source_.skin.distance->inside(point); }

 private:
  const SkinSource& source_;
  std::vector<std::uint8_t> buried_;   ///< #F; empty: all triangles are free
  std::vector<geometry::Index> free_;  ///< indices of the free triangles; empty: all triangles are free
  std::unique_ptr<geometry::MeshDistance> own_;
  const geometry::MeshDistance* distance_;
};

}  // namespace bodice::fitting
