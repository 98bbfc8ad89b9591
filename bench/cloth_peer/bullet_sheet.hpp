#pragma once

#include <memory>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

/// The scene as a soft body of Bullet: links of full stiffness, bending links of a twentieth of it, four
/// sweeps a substep, and contact of full hardness with signed distances in voxels of a sixteenth of the
/// ball's radius.
class BulletSheet {
 public:
  explicit BulletSheet(const bodice::geometry::TriMesh& mesh);
  ~BulletSheet();
  BulletSheet(const BulletSheet&) = delete;
  BulletSheet& operator=(const BulletSheet&) = delete;

  void step();  ///< one frame of kSubsteps substeps
  std::vector<bodice::geometry::Vec3> positions() const;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace bench
