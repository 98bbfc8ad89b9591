// Compares a collider in a pose with the scalar reference in double precision. For programs that link the
// collision layer and Highway.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/posed_proxy.hpp>
#include <bodice_test/targets.hpp>

namespace bodice_test {

using bodice::geometry::Vec3;

/// d_k + kappa b_k of every ellipsoid at a point: eq. (4') of posed_proxy.hpp, by brute force. `buries` false
/// leaves burial out.
inline std::vector<double> scores(const bodice::proxy::PosedProxy& posed, const Vec3& point, bool buries) {
  std::vector<double> scores;
  for (std::size_t k = 0; k < posed.shapes.size(); ++k) {
    const bodice::geometry::Ellipsoid& e = posed.shapes[k];
    const bodice::proxy::ReliefTable& table = posed.relief[k];
    const auto closest = bodice::geometry::closest_point(e, point);
    const Vec3 w = (e.axes.transpose() * (closest.point - e.center)).cwiseQuotient(e.radii).normalized();
    const auto stencil = bodice::proxy::table_stencil(w, table.nodes_per_side);
    double depth = 0.0;
    for (int i = 0; i < 4; ++i)
      depth += stencil.weight[i] * posed.burial[table.first_texel + stencil.node[i]];
    scores.push_back(closest.signed_distance +
                     (buries ? bodice::proxy::kBurialWeight * double{posed.burial_step_m} * depth : 0.0));
  }
  return scores;
}

/// Points within 30 mm of vertices of a skin.
inline std::vector<Vec3> points_around(const bodice::geometry::TriMesh& skin, int count, std::uint64_t seed) {
  const bodice::engine::Random random(seed);
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; points.size() < static_cast<std::size_t>(count); i += 4) {
    const double at = random.uniform_at(i) * static_cast<double>(skin.positions.size());
    const Vec3 shift(random.uniform_at(i + 1), random.uniform_at(i + 2), random.uniform_at(i + 3));
    points.push_back(skin.positions[static_cast<std::size_t>(at)] + 0.06 * (shift - Vec3::Constant(0.5)));
  }
  return points;
}

/// Points in the collider's local frame, with their reference.
struct PosedPoints {
  std::vector<float> x, y, z;
  std::vector<bodice::proxy::ProxyDistance> truth;
  std::vector<std::vector<double>> scores, distances;  ///< of each ellipsoid, with and without burial
  int buried = 0;                                      ///< points that burial gives another owner

  bodice::collision::Particles particles() { return {x.size(), x.data(), y.data(), z.data()}; }
};

inline PosedPoints reference_at(const bodice::proxy::BodyProxy& bound, const bodice::proxy::PosedProxy& posed,
                                const bodice::collision::Collider& collider, std::span<const Vec3> points) {
  PosedPoints result;
  for (const Vec3& point : points) {
    const Eigen::Vector3f local = (point - collider.origin()).cast<float>();
    result.x.push_back(local.x());
    result.y.push_back(local.y());
    result.z.push_back(local.z());
    const Vec3 there = local.cast<double>() + collider.origin();
    result.truth.push_back(bodice::proxy::posed_proxy_distance(bound, posed, there));
    result.scores.push_back(scores(posed, there, true));
    const std::vector<double>& distances = result.distances.emplace_back(scores(posed, there, false));
    result.buried += static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin()) !=
                     result.truth.back().owner;
  }
  return result;
}

/// Checks distances and owners of all points on every instruction set: in one call, call after call with a
/// workspace, within a limit, and to first order. Returns how many points have a buried owner to first order,
/// which depends on the body: the caller bounds it.
inline int check_posed_collider(const bodice::collision::Collider& collider, PosedPoints& points) {
  using namespace bodice::collision;
  constexpr double kDistance_m = 3e-5, kScore_m = 5e-6, kLimit_m = 0.004, kBuried_m = 0.003;
  std::vector<Contact> contacts(points.x.size()), kept(points.x.size()), within(points.x.size()),
      first_order(points.x.size()), first_within(points.x.size());
  int most_buried = 0;
  on_every_target([&](const std::string& target) {
    CAPTURE(target);
    Workspace workspace;
    collider.query({}, points.particles(), contacts);
    for (int call = 0; call < 3; ++call) collider.query({}, points.particles(), kept, workspace);
    collider.query({}, points.particles(), within, {.within_m = static_cast<float>(kLimit_m)});
    collider.query({}, points.particles(), first_order, {.accuracy = Accuracy::kFirstOrder});
    collider.query({}, points.particles(), first_within,
                   {.within_m = static_cast<float>(kLimit_m), .accuracy = Accuracy::kFirstOrder});
    int wrong_distance = 0, wrong_owner = 0, unlike = 0, wrong_limit = 0, buried = 0, unlike_first = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Contact& c = contacts[i];
      const double truth = points.truth[i].distance, found = double{c.signed_distance};
      const std::vector<double>& score = points.scores[i];
      wrong_distance += std::abs(found - truth) > kDistance_m;
      wrong_owner += score[c.ellipsoid] > *std::ranges::min_element(score) + kScore_m;
      unlike += kept[i].signed_distance != c.signed_distance || kept[i].ellipsoid != c.ellipsoid;
      const bool inside = c.signed_distance <= static_cast<float>(kLimit_m);
      wrong_limit +=
          inside ? within[i].signed_distance != c.signed_distance : within[i].ellipsoid != kNoEllipsoid;
      // To first order another ellipsoid may own a point, but few that are buried there.
      const std::uint32_t owner = first_order[i].ellipsoid;
      buried += owner != c.ellipsoid && score[owner] > points.distances[i][owner] + kBuried_m;
      const bool first_inside = first_order[i].signed_distance <= static_cast<float>(kLimit_m);
      unlike_first += first_inside ? first_within[i].signed_distance != first_order[i].signed_distance
                                   : first_within[i].ellipsoid != kNoEllipsoid;
    }
    CHECK(wrong_distance == 0);
    CHECK(wrong_owner == 0);
    CHECK(unlike == 0);
    CHECK(wrong_limit == 0);
    CHECK(unlike_first == 0);
    most_buried = std::max(most_buried, buried);
  });
  return most_buried;
}

}  // namespace bodice_test
