// Where joints turn, near the loops of their borders.
#pragma once

#include "landmarks/landmarks.hpp"
#include "skin/ball.hpp"

namespace bodice::anatomy {

/// The joint at the foot of the neck: the loop's center, drawn to the middle of the armpits and of the head
/// and moved by what the body's lengths tell. A border's loop alone follows the chin of a large head and the
/// folds of a nape that is bent back. On a skin that is welded somewhere the armpits may be spoiled, and the
/// loop alone tells. O(#F).
geometry::Vec3 neck_joint(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks,
                          const Ball& head);

/// An elbow or knee: the loop's center, moved along the limb's two bones. `root`: where the limb leaves the
/// trunk, `end`: its tip. Skin weights put the border below the joint, and more so on heavy bodies. O(1).
geometry::Vec3 elbow_joint(const BodyCoordinates& coordinates, const Girth& loop, const geometry::Vec3& root,
                           const geometry::Vec3& end);
geometry::Vec3 knee_joint(const BodyCoordinates& coordinates, const Girth& loop, const geometry::Vec3& root,
                          const geometry::Vec3& end);

}  // namespace bodice::anatomy
