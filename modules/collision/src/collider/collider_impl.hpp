// What a Collider holds, and one block of work at a time.
#pragma once

#include <optional>
#include <vector>

#include <bodice/collision/collider.hpp>

#include "collider/block_io.hpp"
#include "collider/workspace.hpp"
#include "exact/response.hpp"
#include "exact/union_field.hpp"
#include "model/affine_motion.hpp"
#include "model/baked.hpp"
#include "model/relief_tables.hpp"
#include "model/surface_motion.hpp"
#include "simd/dispatch/kernels.hpp"

namespace bodice::collision {

struct Collider::Impl {
  explicit Impl(const proxy::BodyProxy& proxy);

  const ReliefTables* tables() const { return relief ? &*relief : nullptr; }

  /// With what is remembered of the particles, or null: as they are stored, or in an order of each task.
  void query(const engine::Context& context, const Particles& all, std::span<Contact> contacts,
             const QueryOptions& options, WorkspaceData* workspace) const;
  ContactReport resolve(const engine::Context& context, const Particles& particles,
                        const ResolveOptions& options, WorkspaceData* workspace) const;
  /// Particles [begin, end) of the sequence, at most kBatch.
  void query_range(const Particles& particles, std::size_t begin, std::size_t end,
                   const ParticleSequence& sequence, const QueryOptions& options,
                   std::span<Contact> contacts) const;
  bool query_kernel(QueryBatch& batch, std::size_t block, WorkspaceData* workspace) const;
  /// Before a call's batches; memory may be null.
  void begin_call(const Particles& particles, WorkspaceData* workspace) const {
    if (workspace) workspace->candidates.begin_call(particles.count, shapes, relief ? relief->blend_m : 0.0f);
  }
  /// What is remembered of a whole batch, or of the last.
  CacheAccess cache_access_of(const Particles& particles, std::size_t begin, std::size_t end,
                              WorkspaceData* workspace) const;
  /// Of the batch that begins at particle `begin`; contacts may be null.
  static NextBatch next_batch_of(const Particles& particles, std::size_t begin,
                                 const ParticleSequence& sequence, Contact* contacts);
  void resolve_range(const Particles& particles, std::size_t begin, std::size_t end,
                     const ParticleSequence& sequence, const ResolveOptions& options,
                     ContactReport& report) const;
  /// One particle on the exact side, from the arrays and back.
  void resolve_exactly(const Particles& particles, std::uint32_t i, const ResolveOptions& options,
                       ContactReport& report) const;
  Contact exact_contact(const geometry::Vec3& p) const;
  Contact make_contact(const geometry::Vec3& p, double distance_m, const geometry::Vec3& normal,
                       std::uint32_t ellipsoid) const;

  std::uint64_t proxy_hash;
  std::uint64_t poses = 0;
  geometry::Vec3 origin;
  /// Ellipsoids are kept in a spatial order, in which everything below and every index inside the module is:
  /// proxy_index[k] is the proxy's index of ellipsoid k, internal_index[] its inverse.
  std::vector<std::uint32_t> proxy_index, internal_index;
  double margin_m;
  std::vector<geometry::Ellipsoid> shapes;  ///< local frame, now
  UnionField field;
  Baked baked;
  std::optional<ReliefTables> relief;
  std::vector<body::Part> part;
  std::vector<SurfaceMotion> motion;
  std::vector<AffineMotion> affine_motions;  ///< of the last move
  bool moving = false;
  double moved_dt_s = 0.0;
  float travel_m = 0.0f;  ///< longest way of any of its material in the last move
};

}  // namespace bodice::collision
