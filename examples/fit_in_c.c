/* From a body to contacts, in C90: a file of yours or the built-in body is fitted, and a point is queried.
 *
 *      O              O           .
 *     /|\   -fit->   ooo   <----  x   how far, and in which direction out?
 *     / \            o o
 *
 *     fit_in_c [body.obj]
 */
#include <stdio.h>

#include <bodice.h>

static int failed(const char* what) {
  printf("%s: %s\n", what, bodice_last_error());
  return 1;
}

/* Prints the stage; any result but 0 would cancel. */
static int32_t print_stage(void* host, const char* stage) {
  const char** last = host;
  if (*last != stage) printf("%s ...\n", stage);
  *last = stage;
  return 0;
}

int main(int argc, char** argv) {
  bodice_context* context = NULL;
  bodice_skin* skin = NULL;
  bodice_proxy* proxy = NULL;
  bodice_collider* collider = NULL;
  const char* last = NULL;
  bodice_contact contact;
  bodice_landmark landmarks[BODICE_LANDMARKS];
  double measurements[BODICE_MEASUREMENTS];
  double point[3];
  uint32_t i;
  bodice_status status;
  bodice_skin_info info = bodice_default_skin_info();
  bodice_skin_options skin_options = bodice_default_skin_options();
  bodice_fit_options fit_options = bodice_default_fit_options();
  bodice_fit_report report = bodice_default_fit_report();
  bodice_context_options options = bodice_default_context_options();

  options.workers = 0; /* all that the machine has */
  if (bodice_context_create(&options, &context) != BODICE_OK) return failed("context");
  skin_options.progress = fit_options.progress = print_stage;
  skin_options.host = fit_options.host = &last;
  if (argc > 1)
    status = bodice_skin_from_file(context, argv[1], &skin_options, &skin);
  else
    status = bodice_skin_built_in(context, 1, 1.68, &skin_options, &skin);
  if (status != BODICE_OK) return failed("skin");
  if (bodice_skin_get_info(skin, &info) != BODICE_OK) return failed("info");
  for (i = 0; i < info.warnings; ++i) printf("warning: %s\n", bodice_skin_warning(skin, i));
  bodice_skin_get_landmarks(skin, landmarks, BODICE_LANDMARKS);
  bodice_skin_get_measurements(skin, measurements, BODICE_MEASUREMENTS);
  printf("%.2f m tall, %s at a height of %.2f m, %s %.2f m\n", info.stature_m, bodice_landmark_name(0),
         landmarks[0].position[1], bodice_measurement_name(15), measurements[15]);

  fit_options.tier = BODICE_SOLID; /* a tenth of a second; the default follows the skin to 0.2 mm and takes longer */
  if (bodice_fit(context, skin, &fit_options, &proxy, &report) != BODICE_OK) return failed("fit");
  printf("%u ellipsoids, %.1f mm from the skin on average\n", (unsigned)report.ellipsoids, report.gap_mean_m * 1e3);

  if (bodice_collider_create(context, proxy, &collider) != BODICE_OK) return failed("collider");
  for (i = 0; i < 3; ++i) point[i] = landmarks[0].position[i] + 0.1 * info.up[i];
  if (bodice_query_point(collider, point, &contact) != BODICE_OK) return failed("query");
  printf("10 cm above the crown: %.1f mm from the proxy\n", contact.distance * 1e3f);

  bodice_collider_destroy(collider);
  bodice_proxy_destroy(proxy);
  bodice_skin_destroy(skin);
  bodice_context_destroy(context);
  return contact.distance > 0.08f && contact.distance < 0.12f ? 0 : 1;
}
