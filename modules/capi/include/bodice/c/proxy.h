/* Body proxies: from bytes, to bytes, and what is in them. Include bodice.h. */
#ifndef BODICE_C_PROXY_H
#define BODICE_C_PROXY_H

#include <bodice/c/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** An immutable set of ellipsoids, with or without relief, that stands for a body. All uses are const uses.
 */
typedef struct bodice_proxy bodice_proxy;

/** Tiers of accuracy; the README has the numbers. */
enum { BODICE_PAPER = 0, BODICE_SOLID = 1, BODICE_TIGHT = 2, BODICE_RELIEF = 3 };
/** Forms of a proxy's bytes. */
enum { BODICE_BINARY = 0, BODICE_JSON = 1 };

/** Reads either form, which it recognizes by content. `bytes` need no alignment and may go after the call.
 * Hostile bytes are safe: they fail with BODICE_UNREADABLE or BODICE_INVALID_ARGUMENT and a sentence that
 * names the fault. Cost for 89 ellipsoids with relief: a millisecond of the binary form, ten of JSON. Const
 * use of the context. */
BODICE_STABLE bodice_status bodice_proxy_from_bytes(const bodice_context* context, const void* bytes,
                                                    size_t size, bodice_proxy** proxy);
/** Writes the proxy into `bytes` (`capacity` of them, or null and 0) and sets *size to the bytes that it
 * needs. Fails with BODICE_INVALID_ARGUMENT, having set *size, if they do not fit and `bytes` is not null. */
BODICE_STABLE bodice_status bodice_proxy_to_bytes(const bodice_proxy* proxy, int32_t form, void* bytes,
                                                  size_t capacity, size_t* size);
BODICE_STABLE void bodice_proxy_destroy(bodice_proxy* proxy);

/** Numbers of a proxy. */
typedef struct bodice_proxy_info {
  bodice_head head;
  uint32_t ellipsoids;
  uint32_t joints; /**< of the rig that the proxy is bound to; 0: it is not bound */
  int32_t tier;
  int32_t reserved;
  double stature_m;
  double margin_m; /**< that queries take off every distance */
  uint64_t hash;   /**< equal bits have equal hashes */
  uint64_t bytes;  /**< size of ellipsoids and tables in memory */
} bodice_proxy_info;

BODICE_INLINE bodice_proxy_info bodice_default_proxy_info(void) {
  bodice_proxy_info info;
  bodice_fill_defaults(BODICE_PROXY_INFO, &info, sizeof info);
  return info;
}

/** Fills the members of *info that the program knows. */
BODICE_STABLE bodice_status bodice_proxy_get_info(const bodice_proxy* proxy, bodice_proxy_info* info);

/** One ellipsoid at rest; its surface is center + sum over i of axes[i] radii[i] u[i], for all unit vectors
 * u. */
typedef struct bodice_ellipsoid {
  double center[3];
  double axes[3][3]; /**< axes[i]: unit vector of radius i; right-handed */
  double radii[3];
  int32_t part; /**< bodice_part_name() */
  int32_t bone; /**< joint that moves most of its skin, or -1 */
} bodice_ellipsoid;

/** Copies the first `capacity` ellipsoids; bodice_proxy_info has their number. */
BODICE_STABLE bodice_status bodice_proxy_get_ellipsoids(const bodice_proxy* proxy,
                                                        bodice_ellipsoid* ellipsoids, size_t capacity);
/** The name of a joint of a bound proxy, as long as the proxy lives; null if there is no such joint. */
BODICE_STABLE const char* bodice_proxy_joint_name(const bodice_proxy* proxy, uint32_t joint);
/** The matrix of a joint in the pose that the proxy was bound in: joint space to proxy space, 3 rows of 4. */
BODICE_STABLE bodice_status bodice_proxy_get_bind(const bodice_proxy* proxy, uint32_t joint,
                                                  double matrix[12]);
/** The joints that move an ellipsoid of a bound proxy, and their weights: by how much of each joint's motion
 * its center moves. Weights add up to 1; one may be a little below 0, since they are the affine fit to those
 * of the skin. Copies the first `capacity` of them and sets *count to their number; both arrays may be null
 * with a capacity of 0. An unbound proxy has none. */
BODICE_EXPERIMENTAL bodice_status bodice_proxy_get_joint_weights(const bodice_proxy* proxy,
                                                                 uint32_t ellipsoid, uint16_t* joint,
                                                                 float* weight, size_t capacity,
                                                                 size_t* count);

/** Number of parts of a body, and the name of one, such as "forearm_l"; null if there is no such part. */
enum { BODICE_PARTS = 15 };
/** The same with the parts of things that are no person, "part_1" to "part_16". */
enum { BODICE_ALL_PARTS = 31 };
BODICE_STABLE const char* bodice_part_name(int32_t part);

#ifdef __cplusplus
}
#endif

#endif
