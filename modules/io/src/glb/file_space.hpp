// The space that a GLB's meshes are in: the input's unit and axes, less an offset far from the origin.
#pragma once

#include <span>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/io/scene.hpp>

#include "glb_builder.hpp"

namespace bodice::inline v0_1::io {

class FileSpace {
 public:
  explicit FileSpace(const Scene& scene);

  Vec3f to_file(const geometry::Vec3& inside) const {
    return (frame_.to_file(inside) - origin_).cast<float>();
  }
  std::vector<Vec3f> to_file(std::span<const geometry::Vec3> points) const;
  /// Unit normals in the file's axes; they point up where the mesh gives none, since glTF forbids zero.
  std::vector<Vec3f> normals_of(const geometry::TriMesh& mesh) const;
  /// The ellipsoid in the unit and axes of the file, less the offset.
  geometry::Ellipsoid to_file(const geometry::Ellipsoid& shape) const;

  /// Adds a node below the scene's root, translated by the offset that was subtracted from every position.
  std::size_t add_top_node(Json node, GlbBuilder& glb);
  /// Where the input is not in meters with y up, adds the node that turns and scales all top nodes. Call it
  /// last.
  void add_root(GlbBuilder& glb) const;

 private:
  bool is_gltf() const;

  geometry::Frame frame_;
  geometry::Vec3 origin_ = geometry::Vec3::Zero();  // in file units
  Json top_nodes_ = Json::array();
};

/// Adds a material of a linear color.
std::size_t add_material(const char* name, const Vec3f& color, float alpha, bool double_sided,
                         GlbBuilder& glb);

}  // namespace bodice::io
