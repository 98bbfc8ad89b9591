/* Two worlds, and a body that changes while frames run, in C90: each world has its context, body and particle; the
 * second body of each is fitted beside the frames, and takes over between two of them.
 *
 *    world 0, world 1    |1|2|3|4|5|6|...   the same particle, the same workspace
 *    live collider        A A A A B B
 *    beside the frames   |fit B ..|
 */
#include <stdio.h>
#include <stdlib.h>

#include <bodice.h>

enum { WORLDS = 2 };

typedef struct world {
  bodice_context* context;
  bodice_collider* live;
  bodice_workspace* workspace;
  bodice_ticket* next;
  double drop[3]; /* above the first body's head, and inside the taller one's */
} world;

static int failed(const char* what) {
  printf("%s: %s\n", what, bodice_last_error());
  return 1;
}

/* Makes a world with a body of a stature, and begins the next one, 1.3 times as tall. */
static int begin(world* w, double stature_m) {
  bodice_skin* skin = NULL;
  bodice_proxy* proxy = NULL;
  double* positions;
  uint32_t* index;
  uint32_t i;
  int made;
  bodice_context_options options = bodice_default_context_options();
  bodice_fit_options fit_options = bodice_default_fit_options();
  bodice_skin_info info = bodice_default_skin_info();
  bodice_mesh mesh = bodice_default_mesh();

  fit_options.tier = BODICE_SOLID;
  if (bodice_context_create(&options, &w->context) != BODICE_OK) return failed("context");
  if (bodice_skin_built_in(w->context, 1, stature_m, NULL, &skin) != BODICE_OK) return failed("skin");
  if (bodice_fit(w->context, skin, &fit_options, &proxy, NULL) != BODICE_OK) return failed("fit");
  if (bodice_collider_create(w->context, proxy, &w->live) != BODICE_OK) return failed("collider");
  if (bodice_workspace_create(w->context, &w->workspace) != BODICE_OK) return failed("workspace");
  w->drop[0] = w->drop[2] = 0.0;
  w->drop[1] = 1.13 * stature_m;

  bodice_skin_get_info(skin, &info);
  positions = malloc(3 * sizeof *positions * info.vertices);
  index = malloc(3 * sizeof *index * info.triangles);
  if (!positions || !index) return 1;
  bodice_skin_get_mesh(skin, positions, info.vertices, index, info.triangles);
  for (i = 0; i < 3 * info.vertices; ++i) positions[i] *= 1.3;
  mesh.position.x = positions;
  mesh.position.scalar = BODICE_DOUBLE;
  mesh.vertices = info.vertices;
  mesh.index = index;
  mesh.triangles = info.triangles;
  made = bodice_fit_begin(w->context, &mesh, NULL, &fit_options, &w->next) == BODICE_OK; /* copies the mesh */
  free(positions);
  free(index);
  bodice_proxy_destroy(proxy);
  bodice_skin_destroy(skin);
  return made ? 0 : failed("next body");
}

/* One frame; the next body takes over where it is done. Returns -1 on failure, else whether it did. */
static int step(world* w) {
  int32_t done = 0;
  bodice_proxy* proxy = NULL;
  bodice_collider* taller = NULL;
  bodice_particles particles = bodice_default_particles();
  particles.count = 1;
  particles.position.x = w->drop;
  particles.position.scalar = BODICE_DOUBLE;
  if (w->next && bodice_ticket_poll(w->next, &done) == BODICE_OK && done) {
    if (bodice_ticket_take(w->next, NULL, &proxy, NULL) != BODICE_OK) return -failed("take");
    if (bodice_collider_create(w->context, proxy, &taller) != BODICE_OK) return -failed("collider");
    bodice_collider_destroy(w->live);
    bodice_proxy_destroy(proxy);
    bodice_ticket_destroy(w->next);
    w->next = NULL;
    w->live = taller;
  }
  if (bodice_resolve(w->live, &particles, NULL, w->workspace, NULL) != BODICE_OK) return -failed("resolve");
  return done;
}

static void end(world* w) {
  bodice_ticket_destroy(w->next);
  bodice_workspace_destroy(w->workspace);
  bodice_collider_destroy(w->live);
  bodice_context_destroy(w->context);
}

int main(void) {
  static const double stature_m[WORLDS] = {1.4, 1.5};
  world worlds[WORLDS] = {{0}, {0}};
  int k, frames = 0, changed = 0, took, moved = 0;
  for (k = 0; k < WORLDS; ++k)
    if (begin(&worlds[k], stature_m[k]) != 0) return 1;
  for (; changed < WORLDS; ++frames)
    for (k = 0; k < WORLDS; ++k) {
      took = step(&worlds[k]);
      if (took < 0) return 1;
      if (took) {
        ++changed;
        moved += worlds[k].drop[1] != 1.13 * stature_m[k] || worlds[k].drop[2] != 0.0;
        printf("world %d: after %d frames the particle is at %.2f, %.2f, %.2f\n", k, frames, worlds[k].drop[0],
               worlds[k].drop[1], worlds[k].drop[2]);
      }
    }
  for (k = 0; k < WORLDS; ++k) end(&worlds[k]);
  return moved == WORLDS ? 0 : 1;
}
