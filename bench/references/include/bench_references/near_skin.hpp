// The error of a proxy's signed distance at points within 30 mm of the skin, and leaks deep inside.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bench {

/// A point with its exact distance to the skin.
struct Probe {
  bodice::geometry::Vec3 point;
  double signed_distance_m = 0.0;  ///< exact
  bool counts = true;              ///< false next to skin that is buried in another limb
};

/// Errors of a proxy over the probes.
struct NearSkin {
  double mean_mm = 0.0, p95_mm = 0.0, max_mm = 0.0;
  double missed_percent = 0.0;  ///< of all points near the skin: deeper than 1 mm but found outside
  double false_percent = 0.0;   ///< of all points near the skin: over 1 mm outside but found inside
  int deep_leaks = 0;           ///< number of points deeper than 10 mm but found outside
};

/// Points along random directions from an even sample of the skin, and interior points.
std::vector<Probe> near_skin_probes(const bodice::engine::Context& context,
                                    const bodice::geometry::TriMesh& mesh,
                                    const bodice::geometry::MeshDistance& distance);

NearSkin judge(const bodice::engine::Context& context, const bodice::proxy::BodyProxy& proxy,
               const std::vector<Probe>& probes);

}  // namespace bench
