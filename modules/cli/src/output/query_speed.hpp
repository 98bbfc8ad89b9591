// Measures a query on this machine. The time is printed and never part of a result.
#pragma once

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::cli {

/// The time of one query of 10,000 particles within 30 mm of the skin on this thread, in microseconds: the
/// least of many runs. Precondition: a triangle of the skin has an area.
double query_us(const proxy::BodyProxy& proxy, const geometry::TriMesh& skin);

}  // namespace bodice::cli
