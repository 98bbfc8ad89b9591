// BVH motion files: a hierarchy of joints with offsets, and a table of angles and positions, a row a frame.
#pragma once

#include <filesystem>

#include <bodice/engine/result.hpp>

#include "import/scene/file_rig.hpp"

namespace bodice::inline v0_1::io {

/// Reads nodes and one clip in the file's units. Positions replace the offset of their joint; angles are
/// degrees, and the first channel turns outermost. The end of a limb becomes a node named after its parent.
/// Fails with kUnreadable and names the line and the remedy.
engine::Result<FileRig> read_bvh(const std::filesystem::path& file);

}  // namespace bodice::io
