#include <bodice/geometry/mesh_distance.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <bodice/engine/random.hpp>

#include "distance/bvh.hpp"
#include "distance/bvh_nearest.hpp"
#include "distance/winding.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

// Distance over radius from which a dipole replaces its triangles. At 2.5 the sum is within .02 of the exact
// one on bodies, which decides the side of a point except next to a hole. There the finer ratio is used.
constexpr double kCoarseFar = 2.5;
constexpr double kFineFar = 6.0;
/// A winding number in floats decides a comparison where it differs by more than `decided`.
struct FloatPass {
  double far_ratio, decided;
};
constexpr FloatPass kFloatPasses[] = {{kCoarseFar, 0.15}, {kFineFar, 2e-3}};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Whether the border of these triangles is empty. Each edge adds a number of its own, with the sign of its
// direction. A sum of zero that is not an empty border has a chance of 2^-64.
bool is_without_border(const TriMesh& mesh, std::span<const Index> triangles) {
  std::uint64_t sum = 0;
  for (const Index k : triangles)
    for (int c = 0; c < 3; ++c) {
      const std::uint64_t a = mesh.triangles[k][c], b = mesh.triangles[k][(c + 1) % 3];
      if (a < b) sum += engine::mix64(a << 32 | b);
      if (a > b) sum -= engine::mix64(b << 32 | a);
    }
  return sum == 0;
}

}  // namespace

struct MeshDistance::Impl {
  Bvh bvh;
  std::vector<DipoleNode> dipoles;
  bool is_closed;

  Impl(const TriMesh& mesh, Bvh tree)
      : bvh(std::move(tree)),
        dipoles(build_dipoles(bvh)),
        is_closed(is_without_border(mesh, bvh.triangle_of_leaf)) {}

  bool winds_more_than(double number, const Vec3& local) const {
    for (const FloatPass& pass : kFloatPasses) {
      const std::optional<double> found = float_winding_number(bvh, dipoles, local, pass.far_ratio);
      if (!found) break;
      if (std::abs(*found - number) > pass.decided) return *found > number;
    }
    return geometry::winding_number(bvh, dipoles, local, kFineFar) > number;
  }

  /// The limit of a search up to a distance: the next double, so that a point exactly there counts.
  double limit2(double max_distance_m) const {
    const double reach = max_distance_m / bvh.scale;
    return std::nextafter(reach * reach, kInfinity);
  }

  std::optional<SurfacePoint> surface_point_of(const BvhHit& hit) const {
    if (hit.leaf_triangle == ~0u) return std::nullopt;
    return surface_point(hit);
  }

  SurfacePoint surface_point(const BvhHit& hit) const {
    SurfacePoint result;
    const BvhTriangle& t = bvh.triangles[hit.leaf_triangle];
    result.signed_distance = std::sqrt(hit.distance2) * bvh.scale;
    result.point = bvh.origin + bvh.scale * hit.at.point;
    result.normal = t.ab.cross(t.ac).stableNormalized();
    result.triangle = bvh.triangle_of_leaf[hit.leaf_triangle];
    return result;
  }
};

MeshDistance::MeshDistance(const engine::Context& context, const TriMesh& mesh)
    : impl_(std::make_unique<Impl>(mesh, build_bvh(context, mesh))) {}
MeshDistance::MeshDistance(const engine::Context& context, const MeshDistance& like, const TriMesh& mesh)
    : impl_(std::make_unique<Impl>(mesh, refit_bvh(context, like.impl_->bvh, mesh))) {}
MeshDistance::~MeshDistance() = default;
MeshDistance::MeshDistance(MeshDistance&&) noexcept = default;
MeshDistance& MeshDistance::operator=(MeshDistance&&) noexcept = default;

SurfacePoint MeshDistance::closest_point(const Vec3& query) const {
  const Vec3 local = impl_->bvh.to_local(query);
  const BvhHit hit = nearest_triangle(impl_->bvh, local, kInfinity);
  if (hit.leaf_triangle == ~0u) return {.signed_distance = kInfinity};
  SurfacePoint result = impl_->surface_point(hit);
  if (impl_->winds_more_than(0.5, local)) result.signed_distance = -result.signed_distance;
  return result;
}

std::optional<SurfacePoint> MeshDistance::closest_point_within(const Vec3& query,
                                                               double max_distance_m) const {
  if (!(max_distance_m >= 0.0)) return std::nullopt;
  return impl_->surface_point_of(
      nearest_triangle(impl_->bvh, impl_->bvh.to_local(query), impl_->limit2(max_distance_m)));
}

std::optional<SurfacePoint> MeshDistance::closest_point_within(
    const Vec3& query, double max_distance_m, engine::FunctionRef<bool(Index)> counts) const {
  if (!(max_distance_m >= 0.0)) return std::nullopt;
  return impl_->surface_point_of(
      nearest_triangle(impl_->bvh, impl_->bvh.to_local(query), impl_->limit2(max_distance_m), counts));
}

bool MeshDistance::winds_more_than(double number, const Vec3& query) const {
  return impl_->winds_more_than(number, impl_->bvh.to_local(query));
}

bool MeshDistance::is_closed() const {
  return impl_->is_closed;
}

double MeshDistance::winding_number(const Vec3& query) const {
  return geometry::winding_number(impl_->bvh, impl_->dipoles, impl_->bvh.to_local(query), kFineFar);
}

}  // namespace bodice::geometry
