#pragma once

#include <bodice/cloth/solver.hpp>

namespace bench {

/// A torso of 9 by 10 ellipsoids: as many as a fitted body has.
bodice::collision::Collider torso();

/// A poncho: a square sheet over the torso's top, about `particles` in all.
bodice::geometry::TriMesh poncho(std::size_t particles);

}  // namespace bench
