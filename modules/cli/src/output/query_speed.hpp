// Measures a query on this machine. The time is printed and never part of a result.
#pragma once

#include <string>

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::cli {

/// The time of one query of 10,000 particles within 30 mm of the skin on this thread, in microseconds: the
/// least of many runs. Precondition: a triangle of the skin has an area.
double query_us(const proxy::BodyProxy& proxy, const geometry::TriMesh& skin);

/// Prints the time of such queries beside the budget that the fit kept by a cost model, so that results
/// repeat, and the budget that would give it on this machine. `tier` is the one requested; empty: any.
void print_speed(const std::string& tier, double budget_us, const proxy::BodyProxy& proxy,
                 const geometry::TriMesh& skin);

}  // namespace bodice::cli
