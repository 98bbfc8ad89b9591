// The functions of io that skins and fits refer to: WebAssembly has no files, and the page reads meshes
// itself.
#include <bodice/io/rig.hpp>

namespace bodice::inline v0_1::io {
namespace {

engine::Error no_files() {
  return {engine::ErrorCode::kNotFound, "WebAssembly has no files.",
          "Read the file in the page (readMesh() of readers.mjs), and pass its arrays."};
}

}  // namespace

engine::Result<ImportedMesh> import_body(const engine::Context&, const std::filesystem::path&,
                                         const ImportOptions&) {
  return no_files();
}

engine::Result<RiggedBody> import_rigged_body(const engine::Context&, const std::filesystem::path&,
                                              const ImportOptions&) {
  return no_files();
}

engine::Result<ImportedMotion> import_motion(const engine::Context&, const std::filesystem::path&) {
  return no_files();
}

}  // namespace bodice::io
