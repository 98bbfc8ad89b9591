/* The exact distance to a mesh: the reference that a proxy is judged by. Include bodice.h. */
#ifndef BODICE_C_EXACT_H
#define BODICE_C_EXACT_H

#include <bodice/c/particles.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A triangle mesh in memory of the host, meters. */
typedef struct bodice_mesh {
  bodice_head head;
  bodice_vectors position; /**< of the vertices */
  size_t vertices;         /**< number of vertices */
  const void* index;   /**< three vertices a triangle, one triangle after the other; no alignment is needed */
  size_t triangles;    /**< number of triangles */
  int32_t index_bytes; /**< 2, 4 (default) or 8: integers of this size */
  int32_t reserved;
} bodice_mesh;

BODICE_INLINE bodice_mesh bodice_default_mesh(void) {
  bodice_mesh mesh;
  bodice_fill_defaults(BODICE_MESH, &mesh, sizeof mesh);
  return mesh;
}

/** The surface of a mesh, for exact distances. All uses are const uses. */
typedef struct bodice_exact bodice_exact;

/** Prepares a closed mesh that is wound outward; small holes do no harm. Nothing of the mesh is needed
 * afterwards. Fails with BODICE_INVALID_ARGUMENT and names the vertex or triangle at fault. O(n log n), on
 * all threads of the context: 50 milliseconds for 20,000 triangles. */
BODICE_EXPERIMENTAL bodice_status bodice_exact_create(const bodice_context* context, const bodice_mesh* mesh,
                                                      bodice_exact** exact);
BODICE_EXPERIMENTAL void bodice_exact_destroy(bodice_exact* exact);

/** As bodice_query() of a collider, in double precision, with the nearest triangle in place of the ellipsoid.
 * Normals are those of the nearest triangle; there are no parts. Particles are in the world; mask and mass
 * are not read. A particle that is not finite has no contact. Cost: 5 to 20 microseconds a particle, on all
 * threads of the context. */
BODICE_EXPERIMENTAL bodice_status bodice_exact_query(const bodice_exact* exact,
                                                     const bodice_particles* particles,
                                                     const bodice_contacts* contacts);

#ifdef __cplusplus
}
#endif

#endif
