/* The C interface from C90: a proxy from memory, and particles in the program's own structures.
 *
 *      .---.
 *     /     \
 *    |   o-->|x     x        the ball has a radius of 10 cm: the particle inside comes out,
 *     \     /               the other one keeps its bits
 *      '---'
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <bodice.h>

static const char ball[] =
    "{\"format\": \"bodice-proxy\", \"version\": 2, \"tier\": \"solid\", \"metres_per_unit\": 1.0, \"up\": \"y\","
    " \"stature\": 1.7, \"margin\": 0.0, \"source_hash\": \"0000000000000000\", \"ellipsoids\": ["
    "  {\"part\": \"head\", \"center\": [0, 1.6, 0], \"radii\": [0.1, 0.1, 0.1],"
    "   \"axes\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}],"
    " \"relief\": [], \"texels\": \"\"}";

typedef struct vertex {
  float position[3];
  float texture[2];
} vertex;

static int failed(const char* what) {
  printf("%s: %s\n", what, bodice_last_error());
  return 1;
}

int main(void) {
  bodice_context* context = NULL;
  bodice_proxy* proxy = NULL;
  bodice_collider* collider = NULL;
  bodice_workspace* workspace = NULL;
  bodice_context_options options = bodice_default_context_options();
  bodice_particles particles = bodice_default_particles();
  bodice_contact_report report = bodice_default_contact_report();
  vertex vertices[2] = {{{0.05f, 1.6f, 0.0f}, {0.0f, 1.0f}}, {{0.5f, 1.6f, 0.0f}, {1.0f, 0.0f}}};

  printf("%s\n", bodice_build());
  if (bodice_context_create(&options, &context) != BODICE_OK) return failed("context");
  if (bodice_proxy_from_bytes(context, ball, strlen(ball), &proxy) != BODICE_OK) return failed("proxy");
  if (bodice_collider_create(context, proxy, &collider) != BODICE_OK) return failed("collider");
  if (bodice_workspace_create(context, &workspace) != BODICE_OK) return failed("workspace");

  particles.count = 2;
  particles.position.x = vertices[0].position;
  particles.position.stride = sizeof(vertex);
  if (bodice_resolve(collider, &particles, NULL, workspace, &report) != BODICE_OK) return failed("resolve");

  bodice_workspace_destroy(workspace);
  bodice_collider_destroy(collider);
  bodice_proxy_destroy(proxy);
  bodice_context_destroy(context);
  if (report.contacts != 1 || fabs(vertices[0].position[0] - 0.1) > 1e-6) return printf("not outside\n"), 1;
  if (vertices[1].position[0] != 0.5f || vertices[0].texture[1] != 1.0f) return printf("changed too much\n"), 1;
  return 0;
}
