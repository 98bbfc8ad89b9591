// The surfaces in front of the camera, and the light on them.
#pragma once

#include <vector>

#include "raster.hpp"

namespace bodice::inline v0_1::io {

/// A surface ready to draw.
struct Actor {
  std::vector<Vec3f> positions, normals;  ///< #V, meters, y up
  std::vector<Vec3f> colors;              ///< #V, linear light 0..1
  std::vector<geometry::Triangle> triangles;
  bool two_sided = false;  ///< cloth: its inside is visible, and darker
  bool edges = false;      ///< draws the triangles' edges, darker
  bool casts_shadow = true;
};

Actor make_actor(const geometry::TriMesh& mesh, const Vec3f& color, bool two_sided);

/// A key light over the left shoulder of the viewer, with soft shadows, light from the sky and a little from
/// the ground.
class Lighting {
 public:
  Lighting(const std::vector<Actor>& actors, const geometry::Box& box, const View& eye);

  /// Linear light toward the eye from a surface point; `normal` faces the eye.
  Vec3f shade(const Vec3f& point, const Vec3f& normal, const Vec3f& toward_eye, const Vec3f& color) const;

 private:
  /// The visibility of the key light, from 0 (in full shadow) to 1.
  float lit(const Vec3f& point, const Vec3f& normal) const;

  View view_;  // from the light
  DepthBuffer shadow_;
  float bias_;  // pixels of the shadow map
};

}  // namespace bodice::io
