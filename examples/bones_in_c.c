/* A proxy that follows bones, in C90: the built-in body gets a skeleton, and its left elbow bends frame by frame.
 *
 *    shoulder o-----o elbow                     shoulder o-----o
 *              upper  \  forearm       -->        arm           |    matrices[j]: joint j to the world,
 *                      o hand                                   o    as the host's animation has them
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <bodice.h>

enum { MOST_JOINTS = 128, FRAMES = 30 };

static int failed(const char* what) {
  printf("%s: %s\n", what, bodice_last_error());
  return 1;
}

/* Turns a joint, and all that hangs on it, about the x axis through `pivot`; matrices are rows of 3 x 4. */
static void turn(double* m, const double* pivot, double angle) {
  const double c = cos(angle), s = sin(angle);
  int column;
  for (column = 0; column < 4; ++column) {
    const double shift = column == 3 ? 1.0 : 0.0;
    const double y = m[4 + column] - shift * pivot[1], z = m[8 + column] - shift * pivot[2];
    m[4 + column] = c * y - s * z + shift * pivot[1];
    m[8 + column] = s * y + c * z + shift * pivot[2];
  }
}

static int in_forearm(const char* joint) {
  return strstr(joint, "forearm_l") || strstr(joint, "hand_l") || strstr(joint, "finger") || strstr(joint, "thumb");
}

int main(void) {
  static double rest[MOST_JOINTS][12], now[MOST_JOINTS][12];
  bodice_context* context = NULL;
  bodice_skin* skin = NULL;
  bodice_proxy* proxy = NULL;
  bodice_collider* collider = NULL;
  bodice_context_options options = bodice_default_context_options();
  bodice_skin_options skin_options = bodice_default_skin_options();
  bodice_fit_options fit_options = bodice_default_fit_options();
  bodice_proxy_info info = bodice_default_proxy_info();
  bodice_pose pose = bodice_default_pose();
  bodice_landmark landmarks[BODICE_LANDMARKS];
  bodice_contact at_rest, bent;
  int frame, i, wrist = 0, elbow = 0;
  uint32_t joint;

  options.workers = 0;
  skin_options.find_rig = 1; /* or skin_options.rig: bones of your own */
  fit_options.tier = BODICE_SOLID;
  if (bodice_context_create(&options, &context) != BODICE_OK) return failed("context");
  if (bodice_skin_built_in(context, 1, 1.68, &skin_options, &skin) != BODICE_OK) return failed("skin");
  if (bodice_fit(context, skin, &fit_options, &proxy, NULL) != BODICE_OK) return failed("fit");
  if (bodice_collider_create(context, proxy, &collider) != BODICE_OK) return failed("collider");
  if (bodice_proxy_get_info(proxy, &info) != BODICE_OK || info.joints > MOST_JOINTS) return failed("joints");
  bodice_skin_get_landmarks(skin, landmarks, BODICE_LANDMARKS);
  for (i = 0; i < BODICE_LANDMARKS; ++i) {
    if (strcmp(bodice_landmark_name(i), "wrist_l") == 0) wrist = i;
    if (strcmp(bodice_landmark_name(i), "elbow_l") == 0) elbow = i;
  }
  for (joint = 0; joint < info.joints; ++joint) bodice_proxy_get_bind(proxy, joint, rest[joint]);
  if (bodice_query_point(collider, landmarks[wrist].position, &at_rest) != BODICE_OK) return failed("query");

  pose.matrices = now;
  pose.count = info.joints;
  pose.scalar = BODICE_DOUBLE;
  pose.dt_s = 1.0 / 60.0;
  for (frame = 1; frame <= FRAMES; ++frame) {
    memcpy(now, rest, sizeof now);
    for (joint = 0; joint < info.joints; ++joint)
      if (in_forearm(bodice_proxy_joint_name(proxy, joint)) && rest[joint][3] > 0.0)
        turn(now[joint], landmarks[elbow].position, -1.2 * frame / FRAMES);
    if (bodice_collider_pose(collider, &pose) != BODICE_OK) return failed("pose");
  }
  if (bodice_query_point(collider, landmarks[wrist].position, &bent) != BODICE_OK) return failed("query");
  printf("%u joints; where the wrist was: %.1f mm, with a bent elbow %.1f mm\n", (unsigned)info.joints,
         at_rest.distance * 1e3f, bent.distance * 1e3f);

  bodice_collider_destroy(collider);
  bodice_proxy_destroy(proxy);
  bodice_skin_destroy(skin);
  bodice_context_destroy(context);
  return at_rest.distance < 0.01f && bent.distance > 0.05f ? 0 : 1;
}
