#pragma once

#include <bodice/tryon/preparation.hpp>

namespace bodice::tryon {

/// The skin of any source, repaired, as a body of metres. Its stages are load and check.
engine::Result<io::ImportedMesh> load_body(const engine::Context& context, const BodySource& source,
                                           const io::ImportOptions& options);

}  // namespace bodice::tryon
