#pragma once

#include "landmarks/landmarks.hpp"

namespace bodice::anatomy {

/// Where an armpit lies by where its arm points and by how the trunk is built: an arm that is drawn forward
/// or up takes the fold behind it along, which distances along the skin tell only in part. The first answer
/// on a skin that is fused. Precondition: neck, perineum, elbows and the first answers of both armpits are
/// found. O(#V).
std::array<geometry::Vec3, 2> armpits_by_arms(const Skin& skin, const BodyCoordinates& coordinates,
                                              const Landmarks& marks);

}  // namespace bodice::anatomy
