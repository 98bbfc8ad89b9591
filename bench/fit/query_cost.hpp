// What a query against a proxy costs: the measured side of the fit's cost model.
#pragma once

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace fit_bench {

/// Nanoseconds of processor time a particle, one thread, the least of many runs: particles within 30 mm of
/// the skin, in Morton order, with nothing kept from an earlier query.
double query_ns(const bodice::proxy::BodyProxy& proxy, const bodice::geometry::TriMesh& skin);

}  // namespace fit_bench
