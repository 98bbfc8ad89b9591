/* A plug-in of a host: bodice is inside of it, and only plugin_distance() leaves it. */
#include <stddef.h>
#include <string.h>

#include <bodice.h>

__attribute__((visibility("default"))) float plugin_distance(const char* proxy_text, const double* point);

float plugin_distance(const char* proxy_text, const double* point) {
  bodice_context* context = NULL;
  bodice_proxy* proxy = NULL;
  bodice_collider* collider = NULL;
  bodice_contact contact;
  contact.distance = 1e9f;
  if (bodice_context_create(NULL, &context) == BODICE_OK &&
      bodice_proxy_from_bytes(context, proxy_text, strlen(proxy_text), &proxy) == BODICE_OK &&
      bodice_collider_create(context, proxy, &collider) == BODICE_OK)
    bodice_query_point(collider, point, &contact);
  bodice_collider_destroy(collider);
  bodice_proxy_destroy(proxy);
  bodice_context_destroy(context);
  return contact.distance;
}
