// Queries and responses against a body proxy: the paper's section 4. Needs a proxy and particles, nothing
// else.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include <bodice/engine/context.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::collision {

/// Particles as structure of arrays, #P each, in the collider's local frame: world minus Collider::origin().
/// Velocities may be null; `safe_*` is where each particle was last known outside, or null.
struct Particles {
  std::size_t count = 0;
  float *x = nullptr, *y = nullptr, *z = nullptr;                       ///< meters, in/out
  float *vx = nullptr, *vy = nullptr, *vz = nullptr;                    ///< meters a second, in/out
  const float *safe_x = nullptr, *safe_y = nullptr, *safe_z = nullptr;  ///< meters
};

/// Contact::ellipsoid where there is none: an empty proxy, a particle that is not finite, or one farther than
/// QueryOptions::within_m. The distance is then +infinity.
inline constexpr std::uint32_t kNoEllipsoid = ~std::uint32_t{0};

/// Aligned to its size, so that none is stored across two lines of the cache.
struct alignas(32) Contact {
  float signed_distance = 0.0f;  ///< meters to the proxy's surface (margin included), negative inside
  float point[3] = {0, 0, 0};    ///< closest surface point, local frame
  float normal[3] = {0, 1, 0};   ///< outward unit normal there
  std::uint32_t ellipsoid = 0;   ///< index into BodyProxy::ellipsoids(); kNoEllipsoid: nothing to tell
};

/// What a query's answer may be off by.
enum class Accuracy : std::uint8_t {
  kExact,  ///< the closest point of all ellipsoids; relief blends where they meet
  /// Half the time. The ellipsoid that is nearest to first order, and there the plane that touches it where
  /// one step of Newton's leads. Plain ellipsoids: the sign is exact, and errors grow with the fourth power
  /// of the distance, but for few particles to which a neighbor looks nearer than it is, the fewer the
  /// closer they are to the surface. Relief is not blended and jumps between ellipsoids. What both come to:
  /// `bench/collision`. Other particles, and what a workspace keeps, may decide which of two ellipsoids a
  /// particle is told of; the number of workers does not.
  kFirstOrder,
};

struct QueryOptions {
  /// Contact distance: particles whose signed distance is at most this are answered with the same bits as
  /// without a limit (with relief and over 256 ellipsoids near one place: to rounding), all others with
  /// kNoEllipsoid. That depends neither on other particles nor on their order nor on workers. Zero asks for
  /// those inside only, less for deep ones. What is not answered costs a bound; whole blocks of it, nothing.
  float within_m = std::numeric_limits<float>::infinity();
  Accuracy accuracy = Accuracy::kExact;
};

enum class Response : std::uint8_t {
  kPaper,         ///< along the ray from the center, least-distance rule, speed scaling
  kClosestPoint,  ///< closest point of the union's surface, certified outside; normal velocity removed,
                  ///< friction
};

/// Values that are no number, and less than zero where that means nothing, count as zero; a max_push_m that
/// is no number as no limit.
struct ResolveOptions {
  Response response = Response::kClosestPoint;
  float thickness_m = 0.0f;  ///< kept between particle and surface
  float friction = 0.3f;     ///< Coulomb coefficient
  /// Longest move a call, beyond taking back the path from the safe position: particles that start deep
  /// inside come out over several calls (`pending`), and those in a fold of the body without room stay midway
  /// in it.
  float max_push_m = std::numeric_limits<float>::infinity();
  /// Fillets the creases where plain ellipsoids meet, so that normals turn over this length instead of
  /// jumping: the surface rises there by up to 0.29 of it (more where more than two meet). Relief blends by
  /// itself; kPaper does not blend. Twice to three times the cost.
  float blend_m = 0.0f;
};

/// What happened to a batch; add() merges blocks.
struct ContactReport {
  std::uint64_t contacts = 0;
  std::uint64_t contacts_by_part[body::kPartCount] = {};
  std::uint64_t unresolved = 0;      ///< still inside after the fallback; zero, or `paper` mode
  std::uint64_t pending = 0;         ///< on their way out, held back by max_push_m
  std::uint64_t pinched = 0;         ///< put midway where two surfaces leave less room than the thickness
  std::uint64_t wrong_side = 0;      ///< put back on the side of the body that their path came from
  std::uint64_t fallbacks = 0;       ///< resolved by the certified fallback
  std::uint64_t judged_exactly = 0;  ///< not settled by the float kernels; includes some without contact
  std::uint64_t not_finite = 0;      ///< NaN or Inf, left alone
  std::uint32_t max_iterations = 0;
  float deepest_m = 0.0f;  ///< depth of the deepest particle before the response
  void add(const ContactReport& other);
};

/// What a caller keeps from call to call for one set of particles: a spatial order, so that the speed does
/// not depend on the order in which they are stored, and which ellipsoids are near, which holds while
/// particles and proxy move by millimeters. Changes no bit of an answer. Refreshed by itself; any collider
/// may use it. Not thread-safe; allocates, about 30 bytes a particle, when these become more.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;

 private:
  friend class Collider;
  std::unique_ptr<struct WorkspaceData> data_;
};

/// A proxy baked for queries: floats in a local frame, boxes for culling. Thread-safe but for move_to().
/// Speed: neighbors in space should be neighbors in the arrays, or a Workspace be given.
class Collider {
 public:
  explicit Collider(const proxy::BodyProxy& proxy);
  ~Collider();
  Collider(Collider&&) noexcept;
  Collider& operator=(Collider&&) noexcept;

  const geometry::Vec3& origin() const noexcept;  ///< world position of the local frame's origin
  std::size_t size() const noexcept;              ///< ellipsoids
  std::uint64_t proxy_hash() const noexcept;      ///< of the proxy that it was made from
  /// Whether tables correct the distance; without, it changes by no more than a place moves.
  bool has_relief() const noexcept;
  std::uint64_t poses() const noexcept;  ///< how often move_to() took it elsewhere

  /// Carries the proxy to another pose: `shapes` are its ellipsoids now, world meters, size() of them; tables
  /// move along. Contacts then know the surface's velocity, (now - before) / dt_s, zero if dt_s is not
  /// positive, and safe positions are carried with the ellipsoid they are nearest to. The origin stays.
  /// False, and nothing moves, when their number is another or one of them is not finite, has no extent or
  /// has axes that are not orthonormal and right-handed (a rig's matrix may carry a scale: it belongs to the
  /// radii). Allocates nothing; must not overlap another call. Cost: about 0.1 microseconds an ellipsoid.
  bool move_to(std::span<const geometry::Ellipsoid> shapes, double dt_s) noexcept;
  /// Velocity of the body's material at a place carried by an ellipsoid; meters a second, local frame.
  geometry::Vec3 surface_velocity(std::uint32_t ellipsoid, const geometry::Vec3& local_point) const noexcept;

  /// Signed distance, closest point, normal and owner of each particle; contacts has particles.count entries
  /// (with fewer, only so many particles are asked about). Throws engine::Canceled if the context's work is
  /// canceled: what contacts hold then is unspecified.
  void query(const engine::Context& context, const Particles& particles, std::span<Contact> contacts,
             const QueryOptions& options = {}) const;
  void query(const engine::Context& context, const Particles& particles, std::span<Contact> contacts,
             Workspace& workspace, const QueryOptions& options = {}) const;
  Contact query(const float (&local_point)[3], const QueryOptions& options = {}) const noexcept;
  /// Every ellipsoid within `within_m` of the point, nearest first, each with its own surface (and table);
  /// returns how many there are, which may be more than fit into `contacts`.
  std::size_t query_all(const float (&local_point)[3], float within_m,
                        std::span<Contact> contacts) const noexcept;

  /// Moves every particle that is inside (or nearer than the thickness) out and corrects its velocity.
  /// Allocates nothing once warm. Throws engine::Canceled as query() does: some particles are out then.
  ContactReport resolve(const engine::Context& context, const Particles& particles,
                        const ResolveOptions& options) const;
  ContactReport resolve(const engine::Context& context, const Particles& particles,
                        const ResolveOptions& options, Workspace& workspace) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::collision
