/* Log, memory and clock of the host, in C90.
 *
 *    bodice --- a line ----------> log       to the host's own log, never two lines at a time
 *           --- bytes, alignment -> allocate  lists of the particles that are not pinned, and all comes back
 *           --- what time is it? -> now_ns
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <bodice.h>

typedef struct host {
  unsigned lines, blocks, taken;
  size_t bytes;
  int64_t time_ns;
} host;

static void take_line(void* context, int32_t level, const char* message) {
  static const char* const levels[] = {"debug", "info", "warning", "error"};
  ++((host*)context)->lines;
  printf("[%s] %s\n", levels[level & 3], message);
}

/* A block at a multiple of the alignment, a power of two; what malloc gave stands before it. */
static void* allocate(void* context, size_t bytes, size_t alignment) {
  host* self = context;
  char *raw = malloc(bytes + alignment + sizeof(void*)), *block = raw + sizeof(void*);
  if (!raw) return NULL; /* the call then fails with BODICE_OUT_OF_MEMORY */
  block += (alignment - (size_t)block % alignment) % alignment;
  memcpy(block - sizeof raw, &raw, sizeof raw);
  ++self->blocks, ++self->taken;
  self->bytes += bytes;
  return block;
}

static void release(void* context, void* block, size_t bytes) {
  host* self = context;
  void* raw;
  memcpy(&raw, (char*)block - sizeof raw, sizeof raw);
  free(raw);
  --self->blocks;
  self->bytes -= bytes;
}

static int64_t now_ns(void* context) {
  return ((host*)context)->time_ns += 1000000; /* a game's own clock, for example one that can be paused */
}

int main(void) {
  host self = {0, 0, 0, 0, 0};
  bodice_context* context = NULL;
  bodice_skin* skin = NULL;
  bodice_proxy* proxy = NULL;
  bodice_collider* collider = NULL;
  bodice_workspace* workspace = NULL;
  bodice_context_options options = bodice_default_context_options();
  bodice_fit_options fit = bodice_default_fit_options();
  bodice_particles particles = bodice_default_particles();
  double positions[2][3] = {{0.0, 1.0, 0.0}, {3.0, 1.0, 0.0}};
  const uint8_t is_free[2] = {1, 0}; /* the second one is pinned */
  unsigned warm;
  int frame, ok;

  options.host = &self;
  options.log = take_line;
  options.log_level = BODICE_DEBUG;
  options.allocate = allocate;
  options.release = release;
  options.now_ns = now_ns;
  fit.tier = BODICE_SOLID;
  fit.target_error_m = 0.001; /* which twenty ellipsoids cannot reach: a line in the log reports it */
  fit.max_ellipsoids = 20;
  particles.count = 2;
  particles.position.x = positions;
  particles.position.scalar = BODICE_DOUBLE;
  particles.mask = is_free;
  ok = bodice_context_create(&options, &context) == BODICE_OK &&
       bodice_skin_built_in(context, 0, 1.8, NULL, &skin) == BODICE_OK &&
       bodice_fit(context, skin, &fit, &proxy, NULL) == BODICE_OK &&
       bodice_collider_create(context, proxy, &collider) == BODICE_OK &&
       bodice_workspace_create(context, &workspace) == BODICE_OK;
  warm = 0;
  for (frame = 0; ok && frame < 62; ++frame) {
    if (frame == 2) warm = self.taken; /* the second call is the last one to take memory */
    ok = bodice_resolve(collider, &particles, NULL, workspace, NULL) == BODICE_OK;
  }
  if (!ok) printf("%s\n", bodice_last_error());
  printf("%u lines; %u blocks with %lu bytes taken, %u more in 60 frames\n", self.lines, warm,
         (unsigned long)self.bytes, self.taken - warm);
  ok = ok && self.lines > 0 && warm > 0 && self.taken == warm && self.time_ns > 0;

  bodice_workspace_destroy(workspace);
  bodice_collider_destroy(collider);
  bodice_proxy_destroy(proxy);
  bodice_skin_destroy(skin);
  bodice_context_destroy(context);
  return ok && self.blocks == 0 && self.bytes == 0 ? 0 : 1;
}
