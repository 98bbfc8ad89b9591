#pragma once

#include <memory>

#include <bodice/tryon/preparation.hpp>

namespace bodice::inline v0_1::tryon {

/// The repaired skin from any source, in meters. Its stages are "load" and "check".
engine::Result<io::ImportedMesh> load_body(const engine::Context& context, const BodySource& source,
                                           const io::ImportOptions& options);

/// A body as it was loaded, with the rig of its file, if there is a usable one.
struct LoadedBody {
  io::ImportedMesh body;
  std::shared_ptr<const rig::Rig> rig;
};
engine::Result<LoadedBody> load_rigged_body(const engine::Context& context, const BodySource& source,
                                            const io::ImportOptions& options);

/// The error with the name of its body in front.
engine::Error of_body(engine::Error error, const io::ImportedMesh& body);

}  // namespace bodice::tryon
