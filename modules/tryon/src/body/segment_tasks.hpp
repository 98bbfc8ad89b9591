#pragma once

#include <bodice/engine/task_graph.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// Adds the tasks from a repaired mesh to a segmented skin. Anatomy and the distance field do not depend on
/// each other. The skin gets a copy of the mesh.
engine::Result<engine::Output<std::shared_ptr<SegmentedSkin>>> add_segment_tasks(
    engine::GraphBuilder& builder, const engine::Output<io::ImportedMesh>& mesh,
    const SegmentOptions& options);

}  // namespace bodice::tryon
