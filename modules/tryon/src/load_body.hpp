#pragma once

#include <bodice/tryon/preparation.hpp>

namespace bodice::tryon {

/// The skin of any source, repaired, as a body of meters. Its stages are load and check.
engine::Result<io::ImportedMesh> load_body(const engine::Context& context, const BodySource& source,
                                           const io::ImportOptions& options);

/// The error, with the body that it is about.
engine::Error of_body(engine::Error error, const io::ImportedMesh& body);

}  // namespace bodice::tryon
