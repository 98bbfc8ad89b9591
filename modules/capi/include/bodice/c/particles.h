/* Particles of the host, read and written where they are: queries and responses. Include bodice.h. */
#ifndef BODICE_C_PARTICLES_H
#define BODICE_C_PARTICLES_H

#include <bodice/c/collider.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Vectors of three numbers in memory of the host: an array of structures, or three arrays. */
typedef struct bodice_vectors {
  void* x; /**< the first x; null: there are no such vectors */
  void* y; /**< the first y; y and z both null: they follow each x in memory */
  void* z;
  ptrdiff_t stride; /**< bytes from one element to the next, may be negative; 0: one after the other */
  int32_t scalar;   /**< BODICE_FLOAT or BODICE_DOUBLE */
  int32_t reserved;
} bodice_vectors;

/** Single numbers in memory of the host. */
typedef struct bodice_scalars {
  void* data;       /**< the first one; null: there are none */
  ptrdiff_t stride; /**< as in bodice_vectors */
  int32_t scalar;
  int32_t reserved;
} bodice_scalars;

/** At most so many particles a call. */
#define BODICE_MAX_PARTICLES 0x7fffffff
/** Coordinates: of the world, or of the collider's local frame (world less bodice_collider_get_origin()). */
enum { BODICE_WORLD = 0, BODICE_LOCAL = 1 };

/** Particles of the host. Nothing but `index` needs alignment, and no array is copied: the kernels read 256
 * particles at a time from where they are, and write what a response changes there. */
typedef struct bodice_particles {
  bodice_head head;
  size_t count; /**< particles to handle */
  const uint32_t*
      index;       /**< #count: the element of each in the arrays below; null: elements 0 to count - 1 */
  size_t elements; /**< with an index: number of elements in the arrays */
  bodice_vectors position; /**< meters */
  bodice_vectors velocity; /**< meters a second; may be absent */
  bodice_vectors safe; /**< last positions outside the body, for particles that move fast; may be absent */
  bodice_scalars inverse_mass; /**< 0: the particle stays where it is; may be absent */
  const uint8_t* mask;         /**< 0: the particle stays where it is; may be null */
  ptrdiff_t mask_stride;       /**< bytes; 0: one after the other */
  int32_t space;               /**< BODICE_WORLD (default) or BODICE_LOCAL */
  int32_t reserved;
} bodice_particles;

BODICE_INLINE bodice_particles bodice_default_particles(void) {
  bodice_particles particles;
  bodice_fill_defaults(BODICE_PARTICLES, &particles, sizeof particles);
  return particles;
}

/** What is stored from call to call for one set of particles: a spatial order, the ellipsoids that are near,
 * and memory to copy into. It makes calls faster and never changes a result; it serves any collider. Every
 * use of it changes it. 35 to 110 bytes a particle. */
typedef struct bodice_workspace bodice_workspace;
BODICE_STABLE bodice_status bodice_workspace_create(const bodice_context* context,
                                                    bodice_workspace** workspace);
BODICE_STABLE void bodice_workspace_destroy(bodice_workspace* workspace);

/** Value of bodice_contact.ellipsoid where there is no contact; the distance is then +infinity. */
#define BODICE_NO_ELLIPSOID 0xffffffffu

/** The closest point of the body's surface to a particle. With relief the point is where the normal and the
 * distance lead: on the surface to a millimeter within 30 mm of it, some centimeters off it at 300 mm. */
typedef struct bodice_contact {
  float distance;     /**< meters, negative inside */
  float point[3];     /**< in the coordinates of the particles */
  float normal[3];    /**< outward unit normal there: the gradient of the distance */
  uint32_t ellipsoid; /**< or BODICE_NO_ELLIPSOID */
} bodice_contact;

/** Where a query writes: entry i of each array belongs to the i-th particle. Arrays may be absent. */
typedef struct bodice_contacts {
  bodice_head head;
  bodice_contact*
      contact; /**< if it is all that is wanted, aligned to 32 bytes and packed, it is written directly */
  ptrdiff_t contact_stride; /**< bytes; 0: one after the other */
  bodice_scalars distance;
  bodice_vectors point;
  bodice_vectors normal;
  uint32_t* ellipsoid; /**< one after the other */
  uint8_t* part;       /**< one after the other; 255: no contact */
} bodice_contacts;

BODICE_INLINE bodice_contacts bodice_default_contacts(void) {
  bodice_contacts contacts;
  bodice_fill_defaults(BODICE_CONTACTS, &contacts, sizeof contacts);
  return contacts;
}

/** Settings of a query. */
typedef struct bodice_query_options {
  bodice_head head;
  float within_m; /**< beyond this distance there is no contact, which is faster; default infinity */
  int32_t
      first_order; /**< 1: about twice as fast, with an error that vanishes toward the surface; default 0 */
} bodice_query_options;

BODICE_INLINE bodice_query_options bodice_default_query_options(void) {
  bodice_query_options options;
  bodice_fill_defaults(BODICE_QUERY_OPTIONS, &options, sizeof options);
  return options;
}

/** Finds the contact of each particle; particles are not changed, mask and mass not read. `options` may be
 * null, and `workspace`, too, at the price of allocations. A particle that is not finite has no contact.
 * Fails with BODICE_INVALID_ARGUMENT for arrays that cannot be. Const use of the collider. Allocates nothing
 * once warm. Cost: 14 nanoseconds a particle, with relief 26, on one core. */
BODICE_STABLE bodice_status bodice_query(const bodice_collider* collider, const bodice_particles* particles,
                                         const bodice_query_options* options, bodice_workspace* workspace,
                                         const bodice_contacts* contacts);
/** The contact of one point in the world; its part is that of its ellipsoid, bodice_proxy_get_ellipsoids().
 * Const use. Allocates nothing. Cost: some microseconds. */
BODICE_STABLE bodice_status bodice_query_point(const bodice_collider* collider, const double point[3],
                                               bodice_contact* contact);
/** All ellipsoids within a distance of a point in the world, nearest first, each with its own surface. *found
 * is their number; at most `capacity` are written. Const use. Allocates nothing for a capacity of at most
 * 256. Cost: some microseconds. */
BODICE_STABLE bodice_status bodice_query_all(const bodice_collider* collider, const double point[3],
                                             float within_m, bodice_contact* contacts, size_t capacity,
                                             size_t* found);

/** Settings of a response. */
typedef struct bodice_resolve_options {
  bodice_head head;
  float thickness_m; /**< distance to keep from the surface; default 0 */
  float friction;    /**< Coulomb coefficient; default 0.3 */
  float max_push_m;  /**< longest push a call; default infinity */
  float blend_m;     /**< radius of fillets where plain ellipsoids meet; default 0 */
  int32_t paper;     /**< 1: the response of the published method; default 0 */
  int32_t reserved;
} bodice_resolve_options;

BODICE_INLINE bodice_resolve_options bodice_default_resolve_options(void) {
  bodice_resolve_options options;
  bodice_fill_defaults(BODICE_RESOLVE_OPTIONS, &options, sizeof options);
  return options;
}

/** Counts of what a response did. */
typedef struct bodice_contact_report {
  bodice_head head;
  uint64_t contacts;
  uint64_t contacts_by_part[BODICE_PARTS]; /**< those of a person; parts of things are not counted apart */
  uint64_t unresolved;                     /**< still inside; zero unless `paper` */
  uint64_t pending;                        /**< held back by max_push_m */
  uint64_t pinched;                        /**< in a fold with less room than the thickness */
  uint64_t not_finite;                     /**< not moved */
  uint64_t pinned;                         /**< left alone because of mask or mass */
  float deepest_m;                         /**< before the response */
  int32_t reserved;
} bodice_contact_report;

BODICE_INLINE bodice_contact_report bodice_default_contact_report(void) {
  bodice_contact_report report;
  bodice_fill_defaults(BODICE_CONTACT_REPORT, &report, sizeof report);
  return report;
}

/** Moves each particle out that is inside or nearer than the thickness, and corrects its velocity; all other
 * values keep their bits. With `safe`, particles stay on the side of the body that they came from. `options`,
 * `workspace` and `report` may be null. If an element stands in the index twice, the call takes one thread,
 * and moves that element once or twice. Fails as bodice_query(), and for a setting that is not a number.
 * Const use of the collider. Allocates nothing once warm. Cost: that of a query. */
BODICE_STABLE bodice_status bodice_resolve(const bodice_collider* collider, const bodice_particles* particles,
                                           const bodice_resolve_options* options, bodice_workspace* workspace,
                                           bodice_contact_report* report);

/** Follows each particle on the straight line from `safe` to `position` and finds where it first comes within
 * `thickness_m` of the surface. fraction[i] (#count floats) is the part of the path until then, 1 if it never
 * does; contacts, if not null, are those at that point. Without relief no hit is missed that is deeper than
 * 0.1 mm; relief may hide features thinner than a millimeter. Particles that start within are at 0. Nothing
 * is moved. Fails and may overlap as bodice_query(). Cost: a few queries of the particles that come near; a
 * path that grazes the surface at less than a millimeter takes one for every few tenths of a millimeter. */
BODICE_EXPERIMENTAL bodice_status bodice_sweep(const bodice_collider* collider,
                                               const bodice_particles* particles, float thickness_m,
                                               bodice_workspace* workspace, float* fraction,
                                               const bodice_contacts* contacts);

/** Raises the relief of a collider where the body's skin, in the pose in force, is outside of its surface by
 * more than `tolerance_m` (0.0007 serves; at least 0): a posed table errs most in creases, where cloth that
 * lies on it is below the skin. `skin` are points of the posed skin, such as the vertices that the host
 * draws; of them only positions, index and space count, and points that are not finite are left out.
 * `uncovered` (may be null) is the number of points that were outside. The next bodice_collider_pose() takes
 * it back. Without relief nothing happens. Not a const use of the collider. Allocates nothing once warm.
 * Cost: a query a point, and 0.2 microseconds for one that is outside. */
BODICE_EXPERIMENTAL bodice_status bodice_collider_cover(bodice_collider* collider,
                                                        const bodice_particles* skin, float tolerance_m,
                                                        size_t* uncovered);

#ifdef __cplusplus
}
#endif

#endif
