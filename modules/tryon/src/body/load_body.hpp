#pragma once

#include <memory>

#include <bodice/tryon/preparation.hpp>

namespace bodice::inline v0_1::tryon {

/// Loads a body from any source and repairs its skin, in meters. Its stages are "load" and "check".
engine::Result<io::ImportedMesh> load_body(const engine::Context& context, const BodySource& source,
                                           const io::ImportOptions& options);

/// A body as it was loaded, with the rig of its file, if there is a usable one.
struct LoadedBody {
  io::ImportedMesh body;
  std::shared_ptr<const rig::Rig> rig;
};
/// Loads a body with its rig. A rig that cannot be used gives the warning `rig-not-usable`.
engine::Result<LoadedBody> load_rigged_body(const engine::Context& context, const BodySource& source,
                                            const io::ImportOptions& options);

/// The same error, with the name of the body's file at the beginning of its message.
engine::Error with_body_name(engine::Error error, const io::ImportedMesh& body);

}  // namespace bodice::tryon
