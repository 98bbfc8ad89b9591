// What a query costs on this machine. Printed, never part of a result.
#pragma once

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::cli {

/// Time of one query of 10,000 particles within 30 mm of the skin on this thread, microseconds: the least of
/// many. The skin needs a triangle with an area.
double query_us(const proxy::BodyProxy& proxy, const geometry::TriMesh& skin);

}  // namespace bodice::cli
