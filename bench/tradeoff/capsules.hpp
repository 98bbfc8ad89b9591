// What games put around a body: one capsule a part.
#pragma once

#include <span>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include <bench_references/subject.hpp>

namespace tradeoff {

struct Capsule {
  float start[3], along[3];      ///< meters; the segment goes from start to start + along
  float inverse_squared_length;  ///< 0 for a sphere
  float radius;
};

/// For each part that has vertices: the axis of greatest spread through the mean, the median distance from it
/// as radius, and an end a radius short of where the part ends.
std::vector<Capsule> fit_capsules(const bodice::geometry::TriMesh& mesh,
                                  std::span<const bodice::body::Part> part);

/// Signed distance of every particle to the union.
void capsule_distances(std::span<const Capsule> capsules, const bench::Cloud& particles,
                       std::span<float> distance_m);

}  // namespace tradeoff
