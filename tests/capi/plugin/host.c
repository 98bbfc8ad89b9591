/* The host of the plug-in: a ball of 10 cm is 40 cm away. */
#include <stdio.h>

extern float plugin_distance(const char* proxy_text, const double* point);

static const char ball[] =
    "{\"format\": \"bodice-proxy\", \"version\": 2, \"tier\": \"solid\", \"metres_per_unit\": 1.0, \"up\": \"y\","
    " \"stature\": 1.7, \"margin\": 0.0, \"source_hash\": \"0000000000000000\", \"ellipsoids\": ["
    "  {\"part\": \"head\", \"center\": [0, 1.6, 0], \"radii\": [0.1, 0.1, 0.1],"
    "   \"axes\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}],"
    " \"relief\": [], \"texels\": \"\"}";

int main(void) {
  const double point[3] = {0.5, 1.6, 0.0};
  const float distance = plugin_distance(ball, point);
  printf("%g\n", distance);
  return distance > 0.3999f && distance < 0.4001f ? 0 : 1;
}
