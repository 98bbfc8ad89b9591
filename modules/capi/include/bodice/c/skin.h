/* Bodies from meshes: repaired skins with landmarks, parts and measurements. Include bodice.h; link
 * libbodice.
 */
#ifndef BODICE_C_SKIN_H
#define BODICE_C_SKIN_H

#include <bodice/c/collider.h>
#include <bodice/c/exact.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The repaired mesh of a body, and what is known of it. All uses are const uses. */
typedef struct bodice_skin bodice_skin;

/** The bones of the host, and what binds the vertices of its mesh to them. Names, parents,
 * joints and weights are aligned as their types, matrices need not be. */
typedef struct bodice_rig {
  bodice_head head;
  const bodice_pose*
      bind; /**< joint space to mesh space in the pose of the mesh, meters; its count is #joints */
  const char* const* names;   /**< #joints; null: "joint_0" and so on */
  const int32_t* parents;     /**< #joints: a joint before the child, -1 for a root; null: all are roots */
  size_t vertices;            /**< of the mesh that comes with the rig */
  const uint16_t* joint;      /**< #vertices x joints_per_vertex */
  const float* weight;        /**< the same; 0: unused. Sums are made 1; a vertex without weight is refused */
  uint32_t joints_per_vertex; /**< default 4 */
  int32_t reserved;
} bodice_rig;

BODICE_INLINE bodice_rig bodice_default_rig(void) {
  bodice_rig rig;
  bodice_fill_defaults(BODICE_RIG, &rig, sizeof rig);
  return rig;
}

/** What a mesh is read as: a person, or anything else: a chair, a dog, a hand. */
enum { BODICE_SHAPE_PERSON = 0, BODICE_SHAPE_ANY = 1 };

/** How a mesh becomes a skin. */
typedef struct bodice_skin_options {
  bodice_head head;
  const bodice_rig* rig; /**< the bones that move the body; null: none, or those of the file */
  int32_t find_rig;      /**< 1: a body without bones gets a skeleton and weights; default 0 */
  /** BODICE_SHAPE_PERSON (default), or BODICE_SHAPE_ANY: the whole mesh, without landmarks and with the parts
   * "part_1" to "part_16"; a file without a unit is in meters. Skins of anything can be fitted and queried,
   * but neither measured nor rigged. */
  int32_t shape;
  /** Called now and then with the name of the stage, from any thread, never twice at a time; any value but 0
   * cancels. May be null. */
  int32_t (*progress)(void* host, const char* stage);
  void* host; /**< passed to progress */
} bodice_skin_options;

BODICE_INLINE bodice_skin_options bodice_default_skin_options(void) {
  bodice_skin_options options;
  bodice_fill_defaults(BODICE_SKIN_OPTIONS, &options, sizeof options);
  return options;
}

/** Repairs a mesh, and finds landmarks and parts. Pose and up axis do not matter, but coordinates are meters.
 * `options` may be null. Nothing of mesh and rig is needed afterwards. Fails with BODICE_INVALID_ARGUMENT
 * (names the element; the body is smaller than 0.3 m or taller than 3 m), BODICE_UNUSABLE_GEOMETRY (no human
 * body can be made out) or BODICE_CANCELED. Const use of the context. Cost: 0.3 seconds for 10,000 vertices.
 */
BODICE_EXPERIMENTAL bodice_status bodice_skin_from_mesh(const bodice_context* context,
                                                        const bodice_mesh* mesh,
                                                        const bodice_skin_options* options,
                                                        bodice_skin** skin);
/** The same of a file: OBJ, PLY, STL, glTF/GLB, FBX or Collada, any unit and up axis; the skin is in meters
 * with y up. `path` is UTF-8. The bones of the file are taken along; options->rig must be null. Fails as well
 * with BODICE_NOT_FOUND and BODICE_UNREADABLE. */
BODICE_EXPERIMENTAL bodice_status bodice_skin_from_file(const bodice_context* context, const char* path,
                                                        const bodice_skin_options* options,
                                                        bodice_skin** skin);
/** The built-in body, to try things out: female is 1 or 0, stature_m from 1.2 to 2.2. options->rig must be
 * null.
 */
BODICE_EXPERIMENTAL bodice_status bodice_skin_built_in(const bodice_context* context, int32_t female,
                                                       double stature_m, const bodice_skin_options* options,
                                                       bodice_skin** skin);
BODICE_EXPERIMENTAL void bodice_skin_destroy(bodice_skin* skin);

/** Numbers of a skin. */
typedef struct bodice_skin_info {
  bodice_head head;
  double stature_m;        /**< of the body as if it stood upright */
  double up[3];            /**< feet to head along the trunk, unit length */
  uint32_t vertices;       /**< of the repaired mesh */
  uint32_t triangles;      /**< of the repaired mesh */
  uint32_t input_vertices; /**< of the mesh that was given */
  uint32_t joints;         /**< of the rig; 0: there is none */
  uint32_t warnings;       /**< see bodice_skin_warning() */
  uint32_t reserved;
} bodice_skin_info;

BODICE_INLINE bodice_skin_info bodice_default_skin_info(void) {
  bodice_skin_info info;
  bodice_fill_defaults(BODICE_SKIN_INFO, &info, sizeof info);
  return info;
}

BODICE_EXPERIMENTAL bodice_status bodice_skin_get_info(const bodice_skin* skin, bodice_skin_info* info);
/** What was repaired, found doubtful or left out, with its remedy; as long as the skin lives. Statements that
 * put nothing in doubt begin with "Note: ". Null if there is no such warning. */
BODICE_EXPERIMENTAL const char* bodice_skin_warning(const bodice_skin* skin, uint32_t warning);

/** The name of a joint of the rig, as long as the skin lives; null if there is no such joint. A proxy that is
 * fitted to the skin has the same joints in the same order. */
BODICE_EXPERIMENTAL const char* bodice_skin_joint_name(const bodice_skin* skin, uint32_t joint);
/** The joint that a joint of the rig hangs on, which comes before it; -1 if it is a root or no joint. */
BODICE_EXPERIMENTAL int32_t bodice_skin_joint_parent(const bodice_skin* skin, uint32_t joint);

/** Copies the repaired mesh: the first `vertices` positions, three doubles each, and the first `triangles`
 * triangles. Either array may be null. O(#copied). */
BODICE_EXPERIMENTAL bodice_status bodice_skin_get_mesh(const bodice_skin* skin, double* positions,
                                                       size_t vertices, uint32_t* triangle, size_t triangles);
/** Value of an input vertex that repair has dropped. */
#define BODICE_NO_VERTEX 0xffffffffu
/** The vertex of the skin of the first `capacity` input vertices, or BODICE_NO_VERTEX. */
BODICE_EXPERIMENTAL bodice_status bodice_skin_get_vertex_of_input(const bodice_skin* skin, uint32_t* vertex,
                                                                  size_t capacity);
/** The part (bodice_part_name()) of the first `capacity` vertices of the skin. */
BODICE_EXPERIMENTAL bodice_status bodice_skin_get_parts(const bodice_skin* skin, uint8_t* part,
                                                        size_t capacity);

/** A named point of the body. */
typedef struct bodice_landmark {
  double position[3];
  double confidence; /**< 0 (not found) to 1 */
  uint32_t vertex;   /**< nearest vertex of the skin, or BODICE_NO_VERTEX */
  int32_t reserved;
} bodice_landmark;

/** Number of landmarks, and the name of one, such as "elbow_l"; null if there is none. */
enum { BODICE_LANDMARKS = 28 };
BODICE_EXPERIMENTAL const char* bodice_landmark_name(int32_t landmark);
/** Copies the first `capacity` landmarks. */
BODICE_EXPERIMENTAL bodice_status bodice_skin_get_landmarks(const bodice_skin* skin,
                                                            bodice_landmark* landmarks, size_t capacity);

/** Number of measurements for garments, and the name of one, such as "waist"; null if there is none. They are
 * defined in modules/anatomy/MEASUREMENTS.md. */
enum { BODICE_MEASUREMENTS = 26 };
BODICE_EXPERIMENTAL const char* bodice_measurement_name(int32_t measurement);
/** Takes the measurements and copies the first `capacity`: meters, angles in radians, NaN where one could not
 * be taken. They are meant for a body that stands with its arms away from the trunk. O(#triangles). */
BODICE_EXPERIMENTAL bodice_status bodice_skin_get_measurements(const bodice_skin* skin, double* values,
                                                               size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
