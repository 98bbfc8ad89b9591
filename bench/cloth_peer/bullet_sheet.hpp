#pragma once

#include <memory>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

/// The scene as a soft body of Bullet's: links of full stiffness, bending links of a twentieth, contact by
/// its signed distance fields, four sweeps a substep. Depths are as its contact leaves them: centimetres,
/// whatever the sweeps and the size of its voxels.
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
