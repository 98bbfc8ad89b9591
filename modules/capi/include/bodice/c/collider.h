/* Colliders: a proxy made ready for queries, at rest or in the pose of the host's bones. Include bodice.h. */
#ifndef BODICE_C_COLLIDER_H
#define BODICE_C_COLLIDER_H

#include <bodice/c/proxy.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A proxy made ready for queries. Queries and responses are const uses; posing and moving are not. */
typedef struct bodice_collider bodice_collider;

/** Makes a collider in the pose at rest. Const use of the proxy, which may go afterwards. Cost for 89
 * ellipsoids: 10 microseconds, with relief 2 milliseconds: do it beside the frames. */
BODICE_STABLE bodice_status bodice_collider_create(const bodice_context* context, const bodice_proxy* proxy,
                                                   bodice_collider** collider);
BODICE_STABLE void bodice_collider_destroy(bodice_collider* collider);

/** World position of the collider's local frame, in which it computes with floats: world = local + origin. It
 * is the middle of the proxy at rest and does not change. Accuracy falls with the distance from it: at 1 km
 * by 0.1 mm. */
BODICE_STABLE bodice_status bodice_collider_get_origin(const bodice_collider* collider, double origin[3]);

/** Forms of a matrix that takes points of a bone, or of the body at rest, to the world. */
enum {
  BODICE_ROWS_3X4 = 0,    /**< 12 numbers, row after row: a b c tx, d e f ty, g h i tz */
  BODICE_ROWS_4X4 = 1,    /**< 16 numbers, row after row; the last row is not read */
  BODICE_COLUMNS_4X4 = 2, /**< 16 numbers, column after column, as OpenGL and glTF have them */
  BODICE_COLUMNS_3X4 = 3  /**< 12 numbers, column after column: a d g, b e h, c f i, tx ty tz */
};
/** Types of numbers in arrays. */
enum { BODICE_FLOAT = 0, BODICE_DOUBLE = 1 };

/** Where joints or ellipsoids are in a frame. */
typedef struct bodice_pose {
  bodice_head head;
  const void* matrices; /**< the first matrix; no alignment is needed */
  ptrdiff_t stride;     /**< bytes from one matrix to the next, may be negative; 0: one after the other */
  uint32_t count;       /**< number of matrices */
  int32_t scalar;       /**< BODICE_FLOAT (default) or BODICE_DOUBLE */
  int32_t layout;       /**< BODICE_ROWS_3X4 (default) or another form */
  int32_t tables;       /**< 0: relief tables stay as they are at rest, which is faster; default 1 */
  double dt_s;          /**< time since the last pose, for velocities; 0 (default): the body jumped */
} bodice_pose;

BODICE_INLINE bodice_pose bodice_default_pose(void) {
  bodice_pose pose;
  bodice_fill_defaults(BODICE_POSE, &pose, sizeof pose);
  return pose;
}

/** Poses a collider of a bound proxy: matrices[j] takes the space of joint j to the world, count is the
 * number of the proxy's joints. A matrix may be off by rounding, up to a thousandth, which is mended, and
 * carry a uniform scale. Fails with BODICE_INVALID_ARGUMENT, names joint and reason, and moves nothing, if
 * one is not finite, shears, mirrors or has no extent. Contacts then use the velocity of the skin. Allocates
 * nothing once warm. Cost for 89 ellipsoids: 1.5 milliseconds, without tables 0.05. */
BODICE_STABLE bodice_status bodice_collider_pose(bodice_collider* collider, const bodice_pose* pose);

/** Moves each ellipsoid by itself, for a proxy that is not bound: matrices[k] takes ellipsoid k from rest to
 * the world; count is the number of ellipsoids. Matrices are mended and refused as by bodice_collider_pose(),
 * naming the ellipsoid; a uniform scale goes into the radii. Tables move along. Allocates nothing once warm.
 * Cost: 0.2 microseconds an ellipsoid. */
BODICE_STABLE bodice_status bodice_collider_move(bodice_collider* collider, const bodice_pose* pose);

#ifdef __cplusplus
}
#endif

#endif
