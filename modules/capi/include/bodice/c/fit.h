/* Proxies fitted to skins, now or beside the frames. Include bodice.h; link libbodice. */
#ifndef BODICE_C_FIT_H
#define BODICE_C_FIT_H

#include <bodice/c/skin.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a fit should reach. The defaults give tier relief with 89 ellipsoids. */
typedef struct bodice_fit_options {
  bodice_head head;
  int32_t tier;           /**< BODICE_PAPER to BODICE_RELIEF; -1 (default): what the other members ask for */
  int32_t max_ellipsoids; /**< of the whole body; 0 (default): no bound */
  double target_error_m;  /**< wanted mean gap between proxy and skin; 0 (default): none */
  double budget_us;       /**< wanted time of a query of 10,000 particles; 0 (default): none */
  double time_budget_s;   /**< a fit may stop after this time, and then does not repeat; 0 (default): none */
  int32_t covering;       /**< 1, tier tight: no skin is outside; default 0 */
  int32_t bind;           /**< 1 (default): the proxy of a skin with a rig is bound to its joints */
  int32_t (*progress)(void* host, const char* stage); /**< as in bodice_skin_options */
  void* host;                                         /**< passed to progress */
} bodice_fit_options;

BODICE_INLINE bodice_fit_options bodice_default_fit_options(void) {
  bodice_fit_options options;
  bodice_fill_defaults(BODICE_FIT_OPTIONS, &options, sizeof options);
  return options;
}

/** How well a proxy follows the skin, by the exact signed distance to the mesh. */
typedef struct bodice_fit_report {
  bodice_head head;
  double gap_mean_m; /**< distance between the proxy's surface and the skin, over the surface by area */
  double gap_p95_m;
  double gap_max_m;
  double interior_covered;     /**< share of the body's interior that is inside the proxy, 0 to 1 */
  double skin_outside;         /**< share of the skin's area that is outside, 0 to 1 */
  double skin_outside_depth_m; /**< largest distance from such skin to the proxy */
  double seconds;
  uint32_t ellipsoids;
  uint32_t warnings; /**< that the log of the context has received */
} bodice_fit_report;

BODICE_INLINE bodice_fit_report bodice_default_fit_report(void) {
  bodice_fit_report report;
  bodice_fill_defaults(BODICE_FIT_REPORT, &report, sizeof report);
  return report;
}

/** Fits a proxy. `options` and `report` may be null. The same bits for any number of workers, unless
 * time_budget_s cuts it short. Fails with BODICE_INVALID_ARGUMENT, BODICE_UNUSABLE_GEOMETRY or
 * BODICE_CANCELED. Const use of context and skin. Cost for 8,500 vertices on two idle cores: 1.5 seconds,
 * tier solid 0.1; with more vertices in proportion. */
BODICE_EXPERIMENTAL bodice_status bodice_fit(const bodice_context* context, const bodice_skin* skin,
                                             const bodice_fit_options* options, bodice_proxy** proxy,
                                             bodice_fit_report* report);

/** Binds a proxy that was fitted before, and saved, to the joints of a skin, in place of another fit. The
 * skin has a rig (bodice_skin_options) and stands as the one that the proxy was fitted to, in the same
 * coordinates. Fails with BODICE_INVALID_ARGUMENT if the skin has no rig or more than a tenth of the
 * ellipsoids have their centers outside of it. A fit to the skin with its rig follows joints a little
 * closer, since it sees them bent. Const use of all three. Cost for 89 ellipsoids with relief: 0.3 seconds of
 * one core. */
BODICE_EXPERIMENTAL bodice_status bodice_proxy_bind(const bodice_context* context, const bodice_proxy* proxy,
                                                    const bodice_skin* skin, bodice_proxy** bound);

/** A body that becomes skin and proxy beside the frames, on a thread of its own and the workers of the
 * context. Polling and canceling are const uses. */
typedef struct bodice_ticket bodice_ticket;

/** Begins bodice_skin_from_mesh() and bodice_fit() and returns; mesh and rig are copied. The progress of
 * skin_options serves both, options->progress is not read. Refuses a mesh that cannot be at once. */
BODICE_EXPERIMENTAL bodice_status bodice_fit_begin(const bodice_context* context, const bodice_mesh* mesh,
                                                   const bodice_skin_options* skin_options,
                                                   const bodice_fit_options* options, bodice_ticket** ticket);
/** Sets *done to 1 once the work is over. No cost: for every frame. */
BODICE_EXPERIMENTAL bodice_status bodice_ticket_poll(const bodice_ticket* ticket, int32_t* done);
/** Requests that the work stop; it ends soon after with BODICE_CANCELED. */
BODICE_EXPERIMENTAL bodice_status bodice_ticket_cancel(const bodice_ticket* ticket);
/** Waits for the end and gives the results away, once. Returns the status and the sentence of the work.
 * `skin` and `report` may be null. */
BODICE_EXPERIMENTAL bodice_status bodice_ticket_take(bodice_ticket* ticket, bodice_skin** skin,
                                                     bodice_proxy** proxy, bodice_fit_report* report);
/** Cancels the work and waits until it has stopped, usually some milliseconds. */
BODICE_EXPERIMENTAL void bodice_ticket_destroy(bodice_ticket* ticket);

#ifdef __cplusplus
}
#endif

#endif
