// The data of a Collider, and its work on one batch at a time.
#pragma once

#include <vector>

#include <bodice/collision/collider.hpp>

#include "collider/block_io.hpp"
#include "collider/cover_scratch.hpp"
#include "collider/workspace.hpp"
#include "exact/response.hpp"
#include "exact/union_field.hpp"
#include "model/affine_motion.hpp"
#include "model/particle_view.hpp"
#include "model/proxy_model.hpp"
#include "model/surface_motion.hpp"
#include "simd/dispatch/kernels.hpp"

namespace bodice::inline v0_1::collision {

/// The data of a Collider: a proxy in all the forms that queries and responses read.
struct Collider::Impl {
  explicit Impl(const proxy::BodyProxy& proxy, engine::MemoryResource* memory);

  /// `workspace` may be null: each task then visits its particles in the order of the arrays, or in a sorted
  /// order of its own.
  void query(const engine::Context& context, const ParticleView& all, std::span<Contact> contacts,
             const QueryOptions& options, WorkspaceData* workspace) const;
  ContactReport resolve(const engine::Context& context, const ParticleView& all,
                        const ResolveOptions& options, WorkspaceData* workspace) const;
  /// Queries the particles [begin, end) of the sequence, at most kBatch.
  void query_range(const ParticleView& particles, std::size_t begin, std::size_t end,
                   const ParticleSequence& sequence, const QueryOptions& options,
                   std::span<Contact> contacts) const;
  class RangeQuery;  ///< the steps of query_range()
  /// Starts a call with the current pose: refreshes order and candidate cache of the workspace, which may be
  /// null, and returns the order to visit all particles in.
  ParticleSequence begin_call(const ParticleView& particles, WorkspaceData* workspace) const;
  /// The candidate cache of a batch; none unless the batch is whole or the last one.
  CacheAccess cache_access_of(const ParticleView& particles, std::size_t begin, std::size_t end,
                              WorkspaceData* workspace) const;
  /// Addresses to prefetch of the batch that begins at particle `begin`; contacts may be null.
  static NextBatch next_batch_of(const ParticleView& particles, std::size_t begin,
                                 const ParticleSequence& sequence, Contact* contacts);
  void resolve_range(const ParticleView& particles, std::size_t begin, std::size_t end,
                     const ParticleSequence& sequence, const ResolveOptions& options,
                     ContactReport& report) const;
  /// Resolves the particles [begin, end) with the kernel. Unless it is done, no particle has moved, and
  /// nothing is counted.
  Status resolve_by_kernel(const ParticleView& particles, std::size_t begin, std::size_t end,
                           const ParticleSequence& sequence, const ResolveOptions& options,
                           ContactReport& report) const;
  /// Resolves the particles [begin, end), at most kBatch, on the exact side.
  void resolve_all_exactly(const ParticleView& particles, std::size_t begin, std::size_t end,
                           const ParticleSequence& sequence, const ResolveOptions& options,
                           ContactReport& report) const;
  ResponseParameters parameters_of(const ResolveOptions& options) const;
  /// Resolves one particle on the exact side, in the caller's arrays.
  void resolve_exactly(const ParticleView& particles, std::uint32_t i, const ResolveOptions& options,
                       ContactReport& report) const;
  Contact exact_contact(const geometry::Vec3& p) const;
  /// Internal index of the ellipsoid that owns a point.
  std::uint32_t owner_of(const geometry::Vec3& p) const;
  Contact make_contact(const geometry::Vec3& p, double distance_m, const geometry::Vec3& normal,
                       std::uint32_t ellipsoid) const;

  /// Checks and mends the ellipsoids of a pose (world), and keeps them in `trial`. False if one is unfit.
  bool take(std::span<const geometry::Ellipsoid> now) noexcept;
  /// Moves ellipsoids (world, valid) and their material; `axes_of_material` empty: it keeps its coordinates
  /// in the ellipsoids' frames.
  void move(std::span<const geometry::Ellipsoid> now, std::span<const geometry::Mat3> axes_of_material,
            double dt_s) noexcept;

  /// Queries the points cover.point of the skin, and lists those that are outside by more than the tolerance.
  void find_uncovered(const engine::Context& context, std::span<const geometry::Vec3> skin,
                      float tolerance_m);
  /// Raises the tables of all owners of listed points.
  void raise_uncovered(const engine::Context& context);

  std::uint64_t proxy_hash;
  std::uint64_t poses = 0;
  geometry::Vec3 origin;
  /// The ellipsoids are in a spatial order, which all members below and all internal indices follow.
  /// proxy_index[k] is the index of ellipsoid k in the proxy; internal_index is the inverse.
  std::vector<std::uint32_t> proxy_index, internal_index;
  double margin_m, rest_margin_m, stature_m;
  std::size_t texels;                       ///< number of texels of the proxy's tables
  std::vector<geometry::Ellipsoid> shapes;  ///< current pose, local frame
  std::vector<geometry::Ellipsoid> trial;   ///< the next pose, world, in the proxy's order
  UnionField field;
  ProxyModel model;
  std::vector<body::Part> part;
  std::vector<InvertedMaterial> material, material_before;  ///< one an ellipsoid, in this pose and the last
  std::vector<SurfaceMotion> motion;
  std::vector<AffineMotion> affine_motions;  ///< those of the last move
  bool moving = false;
  double moved_dt_s = 0.0;
  CoverScratch cover;
  float travel_m = 0.0f;  ///< bound on the displacement of any material in the last move
};

}  // namespace bodice::collision
