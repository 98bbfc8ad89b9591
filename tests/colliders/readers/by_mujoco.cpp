// Prints the ellipsoids of an MJCF file as MuJoCo itself sees them, one a line: name of the body, center,
// axes (rows of the rotation), radii.
#include <cstdio>

#include <mujoco/mujoco.h>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  char error[1000] = "";
  mjModel* model = mj_loadXML(argv[1], nullptr, error, sizeof error);
  if (!model) return std::fprintf(stderr, "%s\n", error), 1;
  mjData* data = mj_makeData(model);
  mj_forward(model, data);
  for (int g = 0; g < model->ngeom; ++g) {
    if (model->geom_type[g] != mjGEOM_ELLIPSOID)
      return std::fprintf(stderr, "geom %d is no ellipsoid\n", g), 1;
    std::printf("%s", mj_id2name(model, mjOBJ_BODY, model->geom_bodyid[g]));
    for (int k = 0; k < 3; ++k) std::printf(" %.17g", data->geom_xpos[3 * g + k]);
    for (int k = 0; k < 9; ++k) std::printf(" %.17g", data->geom_xmat[9 * g + k]);
    for (int k = 0; k < 3; ++k) std::printf(" %.17g", model->geom_size[3 * g + k]);
    std::printf("\n");
  }
  mj_deleteData(data);
  mj_deleteModel(model);
  return 0;
}
