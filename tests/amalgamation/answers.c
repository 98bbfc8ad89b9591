/* Calls everything of the frame side for a proxy, and writes the answers to a file or compares them with one.
 *   answers PROXY write|compare FILE [TOLERANCE]
 * Compiled with the library and its bodice.h, or, by -DAMALGAMATION, with the two files to drop in. */
#ifdef AMALGAMATION
#include "bodice_frame.h"
#else
#include <bodice.h>
#endif
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT 4000

static void must(bodice_status status) {
  if (status == BODICE_OK) return;
  fprintf(stderr, "%s\n", bodice_last_error());
  exit(1);
}

static unsigned long state = 1;
static double random_number(double least, double most) {
  state = state * 48271UL % 2147483647UL;
  return least + (most - least) * (double)state / 2147483647.0;
}

/* Distance, point and normal of each contact; positions and velocities of a response; exact distances. */
struct answers {
  float contact[COUNT][7];
  float position[COUNT][3];
  float velocity[COUNT][3];
  double exact[COUNT];
};

static void *read_all(const char *name, size_t *size) {
  FILE *file = fopen(name, "rb");
  void *bytes;
  if (!file) {
    fprintf(stderr, "%s cannot be read\n", name);
    exit(1);
  }
  fseek(file, 0, SEEK_END);
  *size = (size_t)ftell(file);
  rewind(file);
  bytes = malloc(*size + 1);
  if (!bytes || fread(bytes, 1, *size, file) != *size) exit(1);
  fclose(file);
  return bytes;
}

/* A box around the body's middle, to have a mesh. */
static void query_exact(const bodice_context *context, float points[COUNT][3], struct answers *out) {
  static const double xyz[8][3] = {{-0.2, 0.5, -0.2}, {0.2, 0.5, -0.2}, {0.2, 1.2, -0.2}, {-0.2, 1.2, -0.2},
                                   {-0.2, 0.5, 0.2},  {0.2, 0.5, 0.2},  {0.2, 1.2, 0.2},  {-0.2, 1.2, 0.2}};
  static const unsigned char index[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                             {3, 6, 2}, {3, 7, 6}, {0, 4, 7}, {0, 7, 3}, {1, 2, 6}, {1, 6, 5}};
  static uint32_t wide[12][3];
  bodice_mesh mesh = bodice_default_mesh();
  bodice_particles particles = bodice_default_particles();
  bodice_contacts contacts = bodice_default_contacts();
  bodice_exact *exact;
  int i, k;
  for (i = 0; i < 12; ++i)
    for (k = 0; k < 3; ++k) wide[i][k] = index[i][k];
  mesh.position.x = (void *)xyz;
  mesh.position.scalar = BODICE_DOUBLE;
  mesh.vertices = 8;
  mesh.index = wide;
  mesh.triangles = 12;
  must(bodice_exact_create(context, &mesh, &exact));
  particles.count = COUNT;
  particles.position.x = points;
  contacts.distance.data = out->exact;
  contacts.distance.scalar = BODICE_DOUBLE;
  must(bodice_exact_query(exact, &particles, &contacts));
  bodice_exact_destroy(exact);
}

static void ask(const void *bytes, size_t size, struct answers *out) {
  static float points[COUNT][3];
  bodice_context_options options = bodice_default_context_options();
  bodice_context *context;
  bodice_proxy *proxy;
  bodice_collider *collider;
  bodice_workspace *workspace;
  bodice_particles particles = bodice_default_particles();
  bodice_contacts contacts = bodice_default_contacts();
  bodice_resolve_options response = bodice_default_resolve_options();
  int i, k;
  for (i = 0; i < COUNT; ++i) {
    points[i][0] = (float)random_number(-0.6, 0.6);
    points[i][1] = (float)random_number(-0.1, 1.8);
    points[i][2] = (float)random_number(-0.25, 0.25);
    for (k = 0; k < 3; ++k) out->velocity[i][k] = (float)random_number(-1.0, 1.0);
  }
  memcpy(out->position, points, sizeof points);
  options.workers = 2;
  must(bodice_context_create(&options, &context));
  must(bodice_proxy_from_bytes(context, bytes, size, &proxy));
  must(bodice_collider_create(context, proxy, &collider));
  must(bodice_workspace_create(context, &workspace));
  particles.count = COUNT;
  particles.position.x = points;
  contacts.distance.data = &out->contact[0][0];
  contacts.point.x = &out->contact[0][1];
  contacts.normal.x = &out->contact[0][4];
  contacts.distance.stride = contacts.point.stride = contacts.normal.stride = sizeof out->contact[0];
  must(bodice_query(collider, &particles, NULL, workspace, &contacts));
  particles.position.x = out->position;
  particles.velocity.x = out->velocity;
  response.thickness_m = 0.002f;
  must(bodice_resolve(collider, &particles, &response, workspace, NULL));
  query_exact(context, points, out);
  printf("%s\n", bodice_build());
  bodice_workspace_destroy(workspace);
  bodice_collider_destroy(collider);
  bodice_proxy_destroy(proxy);
  bodice_context_destroy(context);
}

/* Instruction sets round differently: distances agree to some micrometers, and a few particles at a crease have
 * another owner, and so another point and push. What is exact is computed in doubles, and agrees to their last digits. */
static int compare(const struct answers *a, const struct answers *b, double tolerance) {
  double worst = 0.0;
  int other = 0, rough = 0, i, k;
  for (i = 0; i < COUNT; ++i) {
    double apart = 0.0;
    worst = fmax(worst, fabs((double)a->contact[i][0] - (double)b->contact[i][0]));
    for (k = 0; k < 3; ++k) {
      apart = fmax(apart, fabs((double)a->contact[i][1 + k] - (double)b->contact[i][1 + k]));
      apart = fmax(apart, fabs((double)a->position[i][k] - (double)b->position[i][k]));
    }
    other += apart > 50.0 * tolerance;
    rough += !(fabs(a->exact[i] - b->exact[i]) <= 1e-14);
  }
  printf("distances differ by at most %.3g m, %d points by more than %.3g m, %d exact distances by more than 1e-14 m\n", worst,
         other, 50.0 * tolerance, rough);
  return worst <= tolerance && other <= COUNT / 200 && rough == 0 ? 0 : 1;
}

int main(int argc, char **argv) {
  static struct answers mine;
  size_t size;
  void *bytes;
  int status;
  if (argc < 4) return 2;
  bytes = read_all(argv[1], &size);
  ask(bytes, size, &mine);
  free(bytes);
  if (strcmp(argv[2], "write") == 0) {
    FILE *file = fopen(argv[3], "wb");
    if (!file || fwrite(&mine, sizeof mine, 1, file) != 1 || fclose(file) != 0) return 1;
    return 0;
  }
  bytes = read_all(argv[3], &size);
  status = size == sizeof mine ? compare(&mine, (const struct answers *)bytes, argc > 4 ? atof(argv[4]) : 2e-6) : 1;
  free(bytes);
  return status;
}
