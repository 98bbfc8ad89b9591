#pragma once

#include <memory>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

/// The scene as a soft body of Bullet's: links of full stiffness, bending links of a twentieth, contact of
/// full hardness by its signed distance fields in voxels of a sixteenth of the ball, four sweeps a substep.
class BulletSheet {
 public:
  explicit BulletSheet(const bodice::geometry::TriMesh& mesh);
  ~BulletSheet();
  BulletSheet(const BulletSheet&) = delete;
  BulletSheet& operator=(const BulletSheet&) = delete;

  void step();  ///< a frame of kSubsteps
  std::vector<bodice::geometry::Vec3> positions() const;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace bench
