// Queries and responses of particles against a body proxy, after section 4 of the paper (modules/PAPER.md).
// Only a proxy and particles are needed: no mesh, no solver.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include <bodice/engine/context.hpp>
#include <bodice/engine/memory_resource.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/proxy/posed_proxy.hpp>

namespace bodice::inline v0_1::collision {

/// Particles as a structure of arrays, #P each, in the collider's local frame: world coordinates minus
/// Collider::origin(). `safe_*` holds the last known position of each particle outside the body. Velocities
/// may be null, and safe positions, too; they count only if all three of their arrays are given. Particles
/// without all three of x, y and z are treated as not finite.
struct Particles {
  std::size_t count = 0;
  float *x = nullptr, *y = nullptr, *z = nullptr;                       ///< meters, in/out
  float *vx = nullptr, *vy = nullptr, *vz = nullptr;                    ///< meters a second, in/out
  const float *safe_x = nullptr, *safe_y = nullptr, *safe_z = nullptr;  ///< meters
};

/// Value of Contact::ellipsoid where there is no owner: the proxy is empty, the particle is not finite, or it
/// is farther than QueryOptions::within_m. The distance is then +infinity.
inline constexpr std::uint32_t kNoEllipsoid = ~std::uint32_t{0};

/// Result of a query for one particle. It is aligned to its size, so that none straddles two cache lines.
struct alignas(32) Contact {
  /// Meters to the proxy's surface (margin included), negative inside.
  float signed_distance = std::numeric_limits<float>::infinity();
  float point[3] = {0, 0, 0};              ///< closest surface point, local frame
  float normal[3] = {0, 1, 0};             ///< outward unit normal there
  std::uint32_t ellipsoid = kNoEllipsoid;  ///< index into BodyProxy::ellipsoids(), or kNoEllipsoid
};

/// How exact the result of a query is.
enum class Accuracy : std::uint8_t {
  kExact,  ///< closest point over all ellipsoids; relief blends where ellipsoids meet
  /// Takes about half the time of kExact. The owner is the ellipsoid of least first-order distance; the
  /// contact lies on its tangent plane at the point to which one Newton step leads.
  /// Without relief the sign is exact and the error of the distance is O(distance^4). Near creases a
  /// neighboring ellipsoid may be chosen; that becomes rarer toward the surface. With relief the tables of
  /// two ellipsoids are not blended, so that the distance jumps between them.
  /// Which of two nearly equal ellipsoids is chosen may depend on the other particles and on the workspace,
  /// never on the number of workers. `bench/collision` measures the errors.
  kFirstOrder,
};

/// Settings of a query.
struct QueryOptions {
  /// Contact distance, meters. Particles at this signed distance or less get the same bits as without a
  /// limit, all others kNoEllipsoid; with relief and over 256 ellipsoids near one point the results agree to
  /// rounding. Neither other particles nor their order nor the number of workers change a result. Zero
  /// reports only particles that are inside; a negative value only those deeper than that. A particle beyond
  /// the limit costs one bound, a whole block beyond it nothing.
  float within_m = std::numeric_limits<float>::infinity();
  Accuracy accuracy = Accuracy::kExact;
};

/// How a particle inside the proxy is moved out.
enum class Response : std::uint8_t {
  kPaper,  ///< moved along the ray from the ellipsoid's center by the least-distance rule; speed is scaled
  kClosestPoint,  ///< moved to the closest point of the union's surface, certified to be outside; inward
                  ///< velocity is removed, friction slows the rest
};

/// Settings of a response. NaN, an infinite thickness_m or blend_m, and negative values where they make no
/// sense count as zero. A max_push_m of NaN means no limit.
struct ResolveOptions {
  Response response = Response::kClosestPoint;
  float thickness_m = 0.0f;  ///< distance kept between particle and surface
  float friction = 0.3f;     ///< Coulomb coefficient, 0 or more; kPaper has none
  /// Longest push a call, meters, in addition to the length of the path from the safe position where the push
  /// leads back against that. Particles that start deep inside come out over several calls (`pending`). Those
  /// in a fold of the body without room stay midway in it.
  float max_push_m = std::numeric_limits<float>::infinity();
  /// Radius of the fillets in the creases where plain ellipsoids meet, meters: normals turn over this length
  /// instead of jumping. The surface rises there by up to 0.29 of it, and by more where more than two
  /// ellipsoids meet. Relief blends by itself, and kPaper does not blend. Fillets cost two to three times as
  /// much.
  float blend_m = 0.0f;
};

/// Counts of what a response did to a set of particles; add() merges those of two sets.
struct ContactReport {
  std::uint64_t contacts = 0;  ///< particles inside, or nearer than the thickness
  std::uint64_t contacts_by_part[body::kAllPartCount] = {};
  std::uint64_t unresolved = 0;      ///< still inside at the end; zero but for kPaper
  std::uint64_t pending = 0;         ///< held back by max_push_m before they are out
  std::uint64_t pinched = 0;         ///< put midway where two surfaces leave less room than the thickness
  std::uint64_t wrong_side = 0;      ///< put back on the side of the body that their path came from
  std::uint64_t fallbacks = 0;       ///< resolved by the certified fallback
  std::uint64_t judged_exactly = 0;  ///< left to the exact side; some have no contact
  std::uint64_t not_finite = 0;      ///< NaN or infinite, and not moved
  std::uint32_t max_iterations = 0;  ///< largest number of pushes of one particle
  float deepest_m = 0.0f;            ///< depth of the deepest particle before the response
  /// Adds the counts of another set of particles; of deepest_m and max_iterations the larger one remains.
  void add(const ContactReport& other);
};

/// Settings of Collider::cover().
struct CoverOptions {
  /// Points that are outside of the surface by more than this make it rise, until they are by less, meters.
  /// With less than half a millimeter the surface lies over the skin between its vertices.
  float tolerance_m = 0.7e-3f;
  /// Only points in one of these boxes (world, meters) count; all if absent.
  std::optional<std::span<const geometry::Box>> within;
};

/// Counts of what Collider::cover() did.
struct CoverReport {
  std::size_t uncovered = 0;  ///< points that were outside of the surface by more than the tolerance
  std::size_t left = 0;       ///< those of them that still are
  float farthest_m = 0.0f;    ///< the largest distance by which one was outside
  float left_m = 0.0f;        ///< the largest distance by which one still is; zero if none is left
};

/// The state that a caller keeps from call to call for one set of particles. It holds a spatial order, so
/// that the speed does not depend on the order of the arrays. It also holds the candidate cache, which stays
/// valid while particles and proxy move by millimeters. It never changes a bit of a response or of an exact
/// query, and refreshes itself; any collider may use it. It is not thread-safe. It allocates about 35 bytes a
/// particle, half of it in the second call, and again when the number of particles grows, out of `memory` if
/// it is given, which outlives the workspace.
class Workspace {
 public:
  /// An empty workspace. The calls that it is given to allocate its arrays.
  explicit Workspace(engine::MemoryResource* memory = nullptr);
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;

 private:
  friend class Collider;
  std::unique_ptr<struct WorkspaceData> data_;
};

struct StridedParticles;

/// A body proxy prepared for queries: floats in a local frame, with boxes for the broad phase. Thread-safe
/// except for move_to() and pose(). It is fastest if neighbors in space are neighbors in the arrays, or if a
/// Workspace is given.
class Collider {
 public:
  /// Prepares a proxy; allocates. O(#ellipsoids + #texels), for 89 ellipsoids 10 microseconds, with relief 2
  /// milliseconds: do it beside the frames. The tables of relief lie in `memory` if it is given, which
  /// outlives the collider.
  explicit Collider(const proxy::BodyProxy& proxy, engine::MemoryResource* memory = nullptr);
  ~Collider();
  Collider(Collider&&) noexcept;
  Collider& operator=(Collider&&) noexcept;

  /// World position of the local frame's origin: the middle of the proxy at rest. Local coordinates are
  /// floats, so that accuracy falls with the distance from it, at 1 km by 0.1 mm. Make another collider of a
  /// proxy farther away.
  const geometry::Vec3& origin() const noexcept;
  std::size_t size() const noexcept;          ///< number of ellipsoids
  std::uint64_t proxy_hash() const noexcept;  ///< hash of the proxy that it was made from
  /// Whether relief tables correct the distance. Without them the distance is 1-Lipschitz: it changes by no
  /// more than the point moves.
  bool has_relief() const noexcept;
  std::uint64_t poses() const noexcept;  ///< number of calls of move_to() and pose() that changed the pose

  /// Moves the proxy to another pose: `shapes` are the size() ellipsoids of the new pose in world meters;
  /// relief tables move along. The origin stays. From then on contacts use the surface's velocity, (new - old
  /// position) / dt_s, which is zero if dt_s is not positive. Safe positions move along with the ellipsoid
  /// that they are nearest to. Axes may be off by a thousandth, which is mended, and carry one scale, which
  /// the radii take. Returns false and moves nothing if the number of shapes differs, or if a shape is not
  /// finite, flat, mirrored or sheared: why_refused() of pose_refusal.hpp names it. Allocates nothing and
  /// must not overlap another call. Cost: about 0.1 microseconds an ellipsoid, 0.3 if its axes are mended.
  bool move_to(std::span<const geometry::Ellipsoid> shapes, double dt_s) noexcept;
  /// Moves the proxy to a pose of a bound proxy (binding::Poser), tables included: `posed` has the ellipsoids
  /// and texels of the proxy that the collider was made from, and lengths of its body's size. Velocities and
  /// safe positions are as for move_to(). From then on owners are those of eq. (4') in posed_proxy.hpp: what
  /// was buried at rest yields. Returns false and moves nothing if the numbers differ or an ellipsoid is
  /// unfit, as for move_to(). Allocates nothing and must not overlap another call. Cost: as move_to(), and
  /// some nanoseconds a texel.
  bool pose(const proxy::PosedProxy& posed, double dt_s) noexcept;
  /// Raises relief where points of the body's skin in the pose in force (#S, world, meters), such as its
  /// vertices, are outside of the surface: a table that follows the joints errs most in creases, and cloth
  /// that lies on it there is below the skin. Around such a point the table of its owner rises, in at most
  /// three rounds. Points over 30 mm outside (of 1.70 m) are not of this surface and stay. Nothing is
  /// lowered. The next pose() takes all of it back; after move_to() the tables stay as they are. Without
  /// relief nothing happens. The same bits for any number of workers. Allocates when there are more points
  /// than ever before, and must not overlap another call. Throws engine::Canceled. Cost: a query a point, .2
  /// microseconds for one that is outside, and some microseconds a table that rises; neighbors in space
  /// should be neighbors.
  CoverReport cover(const engine::Context& context, std::span<const geometry::Vec3> skin,
                    const CoverOptions& options = {});
  /// Velocity of the body's material at a point that moves with an ellipsoid; meters a second, local frame.
  geometry::Vec3 surface_velocity(std::uint32_t ellipsoid, const geometry::Vec3& local_point) const noexcept;

  /// Signed distance, closest point, normal and owner of each particle. `contacts` has particles.count
  /// entries; if it has fewer, only so many particles are queried. Throws engine::Canceled if the context is
  /// canceled; the contents of `contacts` are then unspecified. Over 2,048 particles in scattered order are
  /// sorted first, which allocates 16 bytes a particle unless a workspace is given. Cost with a workspace and
  /// 89 ellipsoids: 14 ns a particle on one core, with relief 26 (bench/README.md).
  void query(const engine::Context& context, const Particles& particles, std::span<Contact> contacts,
             const QueryOptions& options = {}) const;
  /// The same, sorted and with candidates as the workspace keeps them.
  void query(const engine::Context& context, const Particles& particles, std::span<Contact> contacts,
             Workspace& workspace, const QueryOptions& options = {}) const;
  /// The same for particles in any other form (strided_particles.hpp), gathered batch by batch. Contacts are
  /// in the local frame, or where StridedParticles::shift_contacts has them.
  void query(const engine::Context& context, const StridedParticles& particles, std::span<Contact> contacts,
             Workspace& workspace, const QueryOptions& options = {}) const;
  /// The contact of one point, meters in the local frame.
  Contact query(const float (&local_point)[3], const QueryOptions& options = {}) const noexcept;
  /// All ellipsoids within `within_m` of the point, nearest first, each with its own surface (and relief
  /// table). Returns their number, which may be more than `contacts` holds.
  std::size_t query_all(const float (&local_point)[3], float within_m,
                        std::span<Contact> contacts) const noexcept;

  /// Moves every particle out that is inside or nearer than the thickness, and corrects its velocity.
  /// Allocates nothing once warm. Throws engine::Canceled as query() does; some particles are out by then.
  /// Cost with a workspace and 89 ellipsoids: 26 ns a particle on one core, with relief 47 (bench/README.md).
  ContactReport resolve(const engine::Context& context, const Particles& particles,
                        const ResolveOptions& options) const;
  /// The same, sorted and with candidates as the workspace keeps them.
  ContactReport resolve(const engine::Context& context, const Particles& particles,
                        const ResolveOptions& options, Workspace& workspace) const;
  /// The same for particles in any other form, gathered and written back batch by batch.
  ContactReport resolve(const engine::Context& context, const StridedParticles& particles,
                        const ResolveOptions& options, Workspace& workspace) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::collision
