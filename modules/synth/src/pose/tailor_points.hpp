// Where tailors measure a made body, known because it was made.
#pragma once

#include <functional>
#include <initializer_list>

#include "pose/truth.hpp"

namespace bodice::inline v0_1::synth {

/// Heights in the rest pose, in units of stature, at which the trunk is measured.
struct TailorLevels {
  double bust, underbust, waist, hip;
};
TailorLevels tailor_levels(const Figure& figure);

/// The farthest point of the skin of some regions on a ray of the rest pose, as the pose moves it.
Vec3 on_ray(const Posed& body, std::initializer_list<Region> regions, const Vec3& origin,
            const Vec3& direction);

/// Calls visit(one, other) with the posed ends of each segment in which a plane of the rest pose cuts the
/// skin of trunk and legs.
void walk_section(const Posed& body, const Vec3& origin, const Vec3& normal,
                  const std::function<void(const Vec3&, const Vec3&)>& visit);

/// Adds the landmarks of tailors: the base of the neck, shoulder tips, bust points, the middles of the trunk
/// at its levels, wrists and ankles.
void add_tailor_landmarks(const Posed& body, std::vector<body::Landmark>& landmarks);

}  // namespace bodice::synth
