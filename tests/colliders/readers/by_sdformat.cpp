// Prints the ellipsoids of an SDF file as SDFormat's own parser sees them, one a line: name of the link,
// center, axes (rows of the rotation), radii.
#include <cstdio>
#include <iostream>

#include <sdf/sdf.hh>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  sdf::Root root;
  for (const sdf::Error& error : root.Load(argv[1])) {
    std::cerr << error.Message() << '\n';
    return 1;
  }
  const sdf::Model* model = root.Model();
  if (!model || !model->Static()) return std::fprintf(stderr, "no static model\n"), 1;
  for (std::uint64_t l = 0; l < model->LinkCount(); ++l) {
    const sdf::Link* link = model->LinkByIndex(l);
    for (std::uint64_t c = 0; c < link->CollisionCount(); ++c) {
      const sdf::Collision* collision = link->CollisionByIndex(c);
      const sdf::Ellipsoid* shape = collision->Geom()->EllipsoidShape();
      ignition::math::Pose3d pose;
      if (!shape || !collision->SemanticPose().Resolve(pose, "__model__").empty())
        return std::fprintf(stderr, "%s is no ellipsoid\n", collision->Name().c_str()), 1;
      std::printf("%s %.17g %.17g %.17g", link->Name().c_str(), pose.Pos().X(), pose.Pos().Y(),
                  pose.Pos().Z());
      const ignition::math::Matrix3d turn(pose.Rot());
      for (int k = 0; k < 9; ++k) std::printf(" %.17g", turn(k / 3, k % 3));
      std::printf(" %.17g %.17g %.17g\n", shape->Radii().X(), shape->Radii().Y(), shape->Radii().Z());
    }
  }
  return 0;
}
