// What a frame costs in which the body moves: everything that moved is refitted, and the contacts of a
// garment that lies 4 mm over the skin are found and resolved. One thread, processor time, median of a few
// frames.
#pragma once

#include <cstddef>

#include <bodice/collision/collider.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>

#include "subject.hpp"

namespace bench {

struct FrameCost {
  double ms = 0.0;
  std::size_t contacts = 0;
};

/// The skin, 4 mm along its normals.
bodice::geometry::TriMesh garment_over(const bodice::geometry::TriMesh& skin);

/// Moves the proxy and resolves every particle, 5 mm thick.
FrameCost proxy_frame(const bodice::proxy::BodyProxy& proxy, const Cloud& cloud,
                      bodice::collision::Response response = bodice::collision::Response::kNearest);

/// Refits two trees of boxes and finds what lies within 5 mm; responds to nothing.
FrameCost tree_frame(bodice::geometry::TriMesh body, bodice::geometry::TriMesh garment);

}  // namespace bench
