#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include <bodice/proxy/proxy_distance.hpp>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

TEST_CASE("relief distances and normals agree with proxy_distance(), which defines them") {
  struct Case {
    int nodes;
    bool sorted_axes;  ///< by falling radius: the kernels read such tables by another code path
  };
  for (const auto& [nodes, sorted_axes] :
       {Case{2, false}, Case{5, false}, Case{16, false}, Case{16, true}, Case{33, false}, Case{33, true}}) {
    auto shapes = random_ellipsoids(8, 60, 0.5, 0.04, 0.2);
    if (sorted_axes)
      for (Ellipsoid& e : shapes) std::sort(e.radii.begin(), e.radii.end(), std::greater<>());
    const auto proxy = proxy_of(with_relief(data_of(shapes), nodes, 0.004, 77));
    const Collider collider(proxy);
    engine::Random random(3);
    Cloud cloud;
    for (int i = 0; i < 20000; ++i) cloud.add(random_vector(random, 0.8));
    std::vector<Contact> contacts(cloud.size());
    collider.query({}, cloud.particles(), contacts);
    double worst_m = 0.0, worst_cosine = 1.0;
    int off_normals = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto truth = proxy::proxy_distance(proxy, cloud.position(i) + collider.origin());
      worst_m = std::max(worst_m, std::abs(truth.distance - double{contacts[i].signed_distance}));
      const float* n = contacts[i].normal;
      const double cosine = truth.normal.dot(Vec3(double{n[0]}, double{n[1]}, double{n[2]}));
      worst_cosine = std::min(worst_cosine, cosine);
      // The gradient jumps where cells or octants of a table meet, and rounding may choose the other side.
      off_normals += cosine < 0.9999;
    }
    CAPTURE(nodes);
    CAPTURE(sorted_axes);
    // The bar is a hundredth of a millimeter: where owners blend over 3 mm, an error of the distance counts
    // eightfold.
    CHECK(worst_m < 1e-5);
    CHECK(off_normals < 60);
  }
}

TEST_CASE("ellipsoids without a relief table are plain beside others that have one") {
  const auto shapes = random_ellipsoids(9, 40, 0.4, 0.05, 0.2);
  auto data = with_relief(data_of(shapes), 8, 0.003, 12);
  for (std::size_t k = 0; k < data.relief.size(); k += 3) data.relief[k] = {};
  const auto proxy = proxy_of(data);
  const Collider collider(proxy);
  engine::Random random(3);
  Cloud cloud;
  for (int i = 0; i < 20000; ++i) cloud.add(random_vector(random, 0.7));
  std::vector<Contact> contacts(cloud.size());
  collider.query({}, cloud.particles(), contacts);
  const Cloud before = cloud;
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  double worst_m = 0.0, lowest_m = 1.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double truth = proxy::proxy_distance(proxy, before.position(i) + collider.origin()).distance;
    worst_m = std::max(worst_m, std::abs(truth - double{contacts[i].signed_distance}));
    lowest_m =
        std::min(lowest_m, proxy::proxy_distance(proxy, cloud.position(i) + collider.origin()).distance);
  }
  CHECK(worst_m < 1e-5);
  CHECK(report.contacts > 1000);
  CHECK(report.unresolved == 0);
  CHECK(lowest_m > -5e-5);
}
