#pragma once

#include <bodice/cloth/solver.hpp>

namespace bench {

/// A torso of 9 by 10 ellipsoids, about as many as a fitted body has.
bodice::collision::Collider torso();

/// A poncho: a square sheet of about `particles` vertices over the top of the torso.
bodice::geometry::TriMesh poncho(std::size_t particles);

}  // namespace bench
