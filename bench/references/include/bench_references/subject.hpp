// What is measured: a body, its proxies and particles near its skin.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>

namespace bench {

/// Positions as structure of arrays, world meters.
struct Cloud {
  std::vector<float> x, y, z;

  std::size_t size() const { return x.size(); }
  void add(const bodice::geometry::Vec3& p);
  bodice::geometry::Vec3 at(std::size_t i) const { return {double{x[i]}, double{y[i]}, double{z[i]}}; }
  bodice::collision::Particles particles() {
    return {.count = size(), .x = x.data(), .y = y.data(), .z = z.data()};
  }
};

bodice::synth::Body make_subject(int vertices);

/// A proxy of the tier with `ellipsoids` ellipsoids, given `seconds` to optimize.
bodice::proxy::BodyProxy fit_subject(const bodice::synth::Body& body,
                                     const bodice::geometry::MeshDistance& skin, bodice::proxy::Tier tier,
                                     int ellipsoids, double seconds);

/// Points within `band_m` of the skin, uniform over area and depth, in random order.
Cloud near_skin(const bodice::geometry::TriMesh& mesh, std::size_t count, double band_m, std::uint64_t seed);

/// The same points in Morton order, like the vertices of a well-ordered garment.
Cloud coherent(const Cloud& cloud);

/// The same points relative to the collider's origin.
Cloud local(const Cloud& cloud, const bodice::collision::Collider& collider);

}  // namespace bench
