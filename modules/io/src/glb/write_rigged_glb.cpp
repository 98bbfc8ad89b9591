#include <bodice/io/rig.hpp>
#include <bodice/io/scene.hpp>

namespace bodice::inline v0_1::io {

engine::Result<void> write_rigged_glb(const geometry::TriMesh& skin, const rig::Rig& rig,
                                      const std::filesystem::path& file) {
  Scene scene;
  scene.body = &skin;
  scene.rig = &rig;
  return write_glb(scene, file);
}

}  // namespace bodice::io
