// Capsules around a body, as games have them.
#pragma once

#include <span>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include <bench_references/subject.hpp>

namespace bench {

/// All points within a radius of a segment.
struct Capsule {
  float start[3], along[3];      ///< meters; the segment runs from start to start + along
  float inverse_squared_length;  ///< 0 for a sphere
  float radius;
};

/// The capsule of some points, at least one: its axis is that of greatest spread through the mean, its radius
/// is the median distance from the axis, and its segment ends a radius before the ends of the points.
Capsule capsule_around(const std::vector<bodice::geometry::Vec3>& points);

/// A capsule for each part that has vertices.
std::vector<Capsule> fit_capsules(const bodice::geometry::TriMesh& mesh,
                                  std::span<const bodice::body::Part> part);

/// Writes the signed distance of every particle to the union of capsules.
void capsule_distances(std::span<const Capsule> capsules, const Cloud& particles,
                       std::span<float> distance_m);

}  // namespace bench
