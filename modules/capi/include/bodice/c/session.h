/* Garments on bodies: sessions that run frame by frame, and whole drapes. Include bodice.h; link libbodice.
 */
#ifndef BODICE_C_SESSION_H
#define BODICE_C_SESSION_H

#include <bodice/c/fit.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A garment in the coordinates of its body, meters, y up. */
typedef struct bodice_garment {
  bodice_head head;
  const char* name;        /**< for sentences; may be null */
  const bodice_mesh* mesh; /**< as it is worn; its vertices keep their order */
  const uint32_t* held;    /**< vertices that stay with the body, such as a waistband; may be null */
  size_t held_count;
} bodice_garment;

BODICE_INLINE bodice_garment bodice_default_garment(void) {
  bodice_garment garment;
  bodice_fill_defaults(BODICE_GARMENT, &garment, sizeof garment);
  return garment;
}

/** How bodies are fitted and garments simulated. */
typedef struct bodice_session_options {
  bodice_head head;
  int32_t tier;           /**< as in bodice_fit_options */
  int32_t max_ellipsoids; /**< as in bodice_fit_options */
  int32_t moves;          /**< 1: bodies get a rig and play motions; default 0 */
  int32_t substeps;       /**< of cloth a frame; default 8 */
  const char* fabric;     /**< name of a preset, such as "denim"; null: cotton */
  double thickness_m;     /**< that cloth keeps from the proxy; default 0.001 */
} bodice_session_options;

BODICE_INLINE bodice_session_options bodice_default_session_options(void) {
  bodice_session_options options;
  bodice_fill_defaults(BODICE_SESSION_OPTIONS, &options, sizeof options);
  return options;
}

/** One body, its garments and its frames. Every use changes it; all calls come from one thread. */
typedef struct bodice_session bodice_session;

/** `options` may be null. Bodies are prepared on the workers of the context. With one worker nothing runs
 * beside the frames: the first step after a submission does the work and is late. */
BODICE_EXPERIMENTAL bodice_status bodice_session_create(const bodice_context* context,
                                                        const bodice_session_options* options,
                                                        bodice_session** session);
/** Cancels the work in progress and waits for it. */
BODICE_EXPERIMENTAL void bodice_session_destroy(bodice_session* session);

/** Prepares a body beside the frames, first coarse, then finer; each proxy takes effect between two steps.
 * Work on an earlier body is canceled. Coordinates are meters with y up. Fails for a mesh that cannot be.
 * Cost: the mesh is copied and repaired in this call, some 10 ms for 10,000 vertices. */
BODICE_EXPERIMENTAL bodice_status bodice_session_submit(bodice_session* session, const bodice_mesh* body);
/** The same for a body file, which is read beside the frames. */
BODICE_EXPERIMENTAL bodice_status bodice_session_submit_file(bodice_session* session, const char* path);

/** States of the preparation that was submitted last. */
enum { BODICE_IDLE = 0, BODICE_WORKING = 1, BODICE_READY = 2 };
/** Sets *state; if the preparation has failed, returns its status and sentence. A clip of
 * bodice_session_play() that was not found is reported once. No cost. */
BODICE_EXPERIMENTAL bodice_status bodice_session_poll(bodice_session* session, int32_t* state);

/** Replaces the garments by the `count` ones of an array, between two steps. Fails with
 * BODICE_INVALID_ARGUMENT and names garment and element; the former ones then stay. */
BODICE_EXPERIMENTAL bodice_status bodice_session_dress(bodice_session* session,
                                                       const bodice_garment* garments, size_t count);
/** Plays a made motion ("walk", "run", "turn", "sit", "dance", ...) or that of a file with a skeleton. `clip`
 * names one of the file; null: its first. Needs `moves`. A motion that is not found fails a later poll. */
BODICE_EXPERIMENTAL bodice_status bodice_session_play(bodice_session* session, const char* motion,
                                                      const char* clip);
/** Frames go on, but the body stays in its pose until bodice_session_resume(). */
BODICE_EXPERIMENTAL bodice_status bodice_session_pause(bodice_session* session);
BODICE_EXPERIMENTAL bodice_status bodice_session_resume(bodice_session* session);
/** Moves to a second of the motion, over `ramp_s` seconds so that garments can follow; zero jumps. Does
 * nothing while nothing is played. Fails with BODICE_INVALID_ARGUMENT for a number that is not finite or
 * below zero. */
BODICE_EXPERIMENTAL bodice_status bodice_session_seek(bodice_session* session, double time_s, double ramp_s);

/** What a step did. */
typedef struct bodice_step_report {
  bodice_head head;
  int32_t has_body;
  int32_t refinement;  /**< 0: the first, coarse proxy of the body in use */
  uint64_t proxy_hash; /**< of the proxy in use */
  uint64_t vertices;   /**< of all garments */
  uint64_t contacts;   /**< of particles with the body, over all substeps */
  double step_ms;
  double clip_s; /**< time of the motion that is shown */
} bodice_step_report;

BODICE_INLINE bodice_step_report bodice_default_step_report(void) {
  bodice_step_report report;
  bodice_fill_defaults(BODICE_STEP_REPORT, &report, sizeof report);
  return report;
}

/** Takes what has become ready, then runs dt_s seconds of motion and cloth. `report` may be null. Allocates
 * nothing once warm, except in the first step of a new proxy. */
BODICE_EXPERIMENTAL bodice_status bodice_session_step(bodice_session* session, double dt_s,
                                                      bodice_step_report* report);
/** Writes the positions of the first `count` vertices of all garments, garment after garment. O(#vertices).
 */
BODICE_EXPERIMENTAL bodice_status bodice_session_get_positions(bodice_session* session,
                                                               const bodice_vectors* positions, size_t count);
/** The proxy in use, at rest; BODICE_NOT_FOUND before the first. */
BODICE_EXPERIMENTAL bodice_status bodice_session_get_proxy(bodice_session* session, bodice_proxy** proxy);
/** A hash of the state of all garments: equal bits have equal hashes. O(#vertices). */
BODICE_EXPERIMENTAL bodice_status bodice_session_get_hash(bodice_session* session, uint64_t* hash);

/** How long a drape is, and what moves the body. */
typedef struct bodice_drape_options {
  bodice_head head;
  int32_t frames;     /**< default 120 */
  int32_t substeps;   /**< default 16 */
  double dt_s;        /**< of a frame; default 1/60 */
  double thickness_m; /**< 0 (default): found from garment, skin and proxy */
  const char* fabric; /**< as in bodice_session_options */
  const char* motion; /**< as in bodice_session_play(); null: the body stands still */
  int32_t (*progress)(void* host, const char* stage); /**< as in bodice_skin_options */
  void* host;                                         /**< passed to progress */
  double tack_m; /**< pieces of a garment this near to each other stay together; default 0.006, 0: none do */
  int32_t find_position; /**< 1: unit, axes and position of each garment are found by where the body is;
                            default 0 */
  int32_t hold; /**< 1: garments without held vertices are held as a wearer does, a skirt by its waistband;
                   default 0 */
} bodice_drape_options;

BODICE_INLINE bodice_drape_options bodice_default_drape_options(void) {
  bodice_drape_options options;
  bodice_fill_defaults(BODICE_DRAPE_OPTIONS, &options, sizeof options);
  return options;
}

/** The numbers of a drape; penetration is measured by the exact distance to the skin. */
typedef struct bodice_drape_report {
  bodice_head head;
  uint64_t hash;                 /**< of the final state */
  uint64_t penetration_over_1mm; /**< particles deeper than 1 mm at the end */
  double penetration_end_m;      /**< deepest particle at the end */
  double penetration_max_m;      /**< deepest particle of any frame */
  double stretch_p95;            /**< strain of edges at the end, 95 % */
  double thickness_m;            /**< in force */
  double frame_ms;               /**< median */
} bodice_drape_report;

BODICE_INLINE bodice_drape_report bodice_default_drape_report(void) {
  bodice_drape_report report;
  bodice_fill_defaults(BODICE_DRAPE_REPORT, &report, sizeof report);
  return report;
}

/** Drapes `count` garments on a skin with its proxy, and writes the positions of all their vertices at the
 * end, garment after garment. `options`, `positions` and `report` may be null. A motion needs a skin with a
 * rig and its bound proxy. Const use of everything. The same bits for any number of workers. Fails as
 * bodice_session_dress(), and with BODICE_CANCELED. Cost: some milliseconds a frame for 5,000 vertices. */
BODICE_EXPERIMENTAL bodice_status bodice_drape(const bodice_context* context, const bodice_skin* skin,
                                               const bodice_proxy* proxy, const bodice_garment* garments,
                                               size_t count, const bodice_drape_options* options,
                                               const bodice_vectors* positions, bodice_drape_report* report);

#ifdef __cplusplus
}
#endif

#endif
