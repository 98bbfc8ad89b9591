// The measured time of a query against a proxy, beside the cost model of fits.
#pragma once

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace fit_bench {

/// Processor time of a query, nanoseconds a particle: the least of many runs on one thread, for particles
/// within 30 mm of the skin, in Morton order, without a workspace.
double query_ns(const bodice::proxy::BodyProxy& proxy, const bodice::geometry::TriMesh& skin);

}  // namespace fit_bench
