// What assimp reads of a rig: nodes, bones, clips.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include <assimp/scene.h>

#include "import/scene/file_rig.hpp"

namespace bodice::inline v0_1::io {

/// A node hierarchy deeper than this is hostile; assimp itself recurses, real rigs have under 50 levels.
inline constexpr int kMaxNodeDepth = 1000;

/// The nodes of a scene in the order of a walk from the root, and where to find them.
struct SceneNodes {
  std::vector<const aiNode*> node;                             ///< #nodes
  std::unordered_map<const aiNode*, std::uint32_t> index;      // looked up only: its order plays no part
  std::unordered_map<std::string, std::uint32_t> first_named;  // likewise
};

/// Fills rig.nodes. Nodes deeper than kMaxNodeDepth are left out.
SceneNodes collect_nodes(const aiScene& scene, FileRig& rig);

/// The bones of a mesh. Those without a node are left out.
std::vector<FileBone> bones_of(const aiMesh& mesh, const SceneNodes& nodes);

/// The scene's clips, ticks converted to seconds.
std::vector<FileClip> clips_of(const aiScene& scene, const SceneNodes& nodes);

}  // namespace bodice::io
