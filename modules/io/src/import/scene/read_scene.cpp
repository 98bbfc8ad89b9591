#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <assimp/config.h>
#include <assimp/scene.h>
#include <Eigen/Geometry>

#include <bodice/io/import.hpp>

#include "import/scene/bind_pose.hpp"
#include "import/scene/file_scene.hpp"
#include "import/scene/gltf_rig.hpp"
#include "import/scene/look_reader.hpp"
#include "import/scene/plain_mesh.hpp"
#include "import/scene/scene_rig.hpp"
#include "import/scene/triangulate.hpp"
#include "import/source/assimp_reader.hpp"
#include "import/source/check_gltf.hpp"
#include "import/source/input_file.hpp"
#include "import/source/try_reading.hpp"

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::Vec3;

geometry::TriMesh to_tri_mesh(const aiMesh& mesh, const Eigen::Matrix4d& to_world, const Vec3& offset) {
  geometry::TriMesh shape;
  const Eigen::Matrix3d linear = to_world.topLeftCorner<3, 3>();
  const Vec3 shift = to_world.topRightCorner<3, 1>() + offset;
  shape.positions.reserve(mesh.mNumVertices);
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    const Vec3 position(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
    shape.positions.push_back(linear * position + shift);
  }
  shape.triangles.reserve(mesh.mNumFaces);
  std::vector<Index> polygon;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3) continue;  // points and lines
    polygon.assign(face.mIndices, face.mIndices + face.mNumIndices);
    if (*std::max_element(polygon.begin(), polygon.end()) < mesh.mNumVertices)
      triangulate(shape.positions, polygon, shape.triangles);
  }
  if (linear.determinant() < 0.0)
    for (geometry::Triangle& triangle : shape.triangles) std::swap(triangle[1], triangle[2]);
  return shape;
}

std::string material_name(const aiScene& scene, const aiMesh& mesh) {
  return mesh.mMaterialIndex < scene.mNumMaterials ? scene.mMaterials[mesh.mMaterialIndex]->GetName().C_Str()
                                                   : "";
}

/// Collects the meshes of all nodes in world coordinates, bound to their bones.
class Collector {
 public:
  Collector(const aiScene& scene, std::optional<GltfDocument> document, const Vec3& offset, FileScene& out)
      : scene_(scene), offset_(offset), out_(out), nodes_(collect_nodes(scene, out.rig)) {
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) skinned_ = skinned_ || scene.mMeshes[i]->mNumBones > 0;
    if (document) gltf_ = GltfRig::match(std::move(*document), nodes_);
  }

  /// Reads looks as well. `materials`: whether what assimp calls materials is from the file.
  void read_looks(const std::filesystem::path& folder, bool materials) {
    look_.emplace(scene_, gltf_ ? &*gltf_ : nullptr, folder, materials, out_.look);
  }

  void collect() {
    for (std::uint32_t n = 0; n < nodes_.node.size(); ++n)
      for (unsigned i = 0; i < nodes_.node[n]->mNumMeshes; ++i)
        add(*scene_.mMeshes[nodes_.node[n]->mMeshes[i]], n, i);
    out_.rig.clips = gltf_ ? gltf_->clips() : clips_of(scene_, nodes_);
  }

 private:
  void add(const aiMesh& mesh, std::uint32_t node, std::size_t primitive) {
    FileMesh result;
    result.name = mesh.mName.length ? mesh.mName.C_Str() : nodes_.node[node]->mName.C_Str();
    result.material = material_name(scene_, mesh);
    const std::vector<FileBone> bones = gltf_ ? gltf_->bones(node, primitive) : bones_of(mesh, nodes_);
    const Eigen::Matrix4d to_world =
        mesh_to_world(bones, out_.rig.nodes, mesh, out_.rig.nodes[node].to_world);
    result.shape = to_tri_mesh(mesh, out_.rig.world_to_file * to_world, offset_);
    if (result.shape.triangles.empty()) return;
    if (look_) result.look = look_->of(mesh, {node, primitive, nodes_.node[node]}, result.shape.triangles);
    out_.rig.has_bones = out_.rig.has_bones || !bones.empty();
    if (skinned_) result.weights = bind_mesh(bones, node, to_world, mesh.mNumVertices, out_.rig);
    out_.meshes.push_back(std::move(result));
  }

  const aiScene& scene_;
  const Vec3& offset_;
  FileScene& out_;
  SceneNodes nodes_;
  std::optional<GltfRig> gltf_;
  std::optional<LookReader> look_;
  bool skinned_ = false;
};

/// assimp multiplies the root node by the document's unit; this keeps the file's own coordinates.
Eigen::Matrix4d undo_collada_unit(const ColladaAsset& asset, FileScene& scene) {
  scene.meters_per_unit = asset.meters_per_unit;
  scene.up = asset.up.value_or(geometry::Axis::kY);  // the default of the standard
  Eigen::Matrix4d world_to_file = Eigen::Matrix4d::Identity();
  world_to_file.topLeftCorner<3, 3>() /= asset.meters_per_unit.value_or(1.0);
  return world_to_file;
}

void read_fbx_metadata(const aiScene& scene, FileScene& out) {
  if (!scene.mMetaData) return;
  int axis = -1;
  if (scene.mMetaData->Get("UpAxis", axis) && axis >= 0 && axis <= 2)
    out.up = static_cast<geometry::Axis>(axis);
  float centimeters_f = 0.0f;
  double centimeters = 0.0;
  if (scene.mMetaData->Get("UnitScaleFactor", centimeters_f))
    centimeters = static_cast<double>(centimeters_f);
  if (centimeters == 0.0) scene.mMetaData->Get("UnitScaleFactor", centimeters);
  if (centimeters > 0.0 && std::isfinite(centimeters)) out.meters_per_unit = 0.01 * centimeters;
}

/// Parses the file. `offset` receives the vector to add to every position.
const aiScene* parse(AssimpReader& reader, const std::filesystem::path& file, Vec3& offset) {
  Assimp::Importer& importer = reader.importer();
  // The document inside an archive is not read here, so that assimp turns it to meters, y up.
  const bool as_stored = reader.format() != Format::kColladaArchive;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, as_stored);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  if (reader.format() == Format::kObj) {
    if (const auto moved = move_to_origin(read_text(file))) {
      offset = moved->offset;
      return reader.read_text(moved->text);
    }
  }
  return reader.read(file);
}

std::string remedy() {
  return "Export it again as " + std::string(kMeshFormats) + ".";
}

engine::Error unreadable(const std::filesystem::path& file, std::string_view why) {
  std::string reason(why.substr(0, why.find('\n')));
  if (reason.size() > 200) reason.resize(200);
  while (!reason.empty() && (reason.back() == '.' || reason.back() == ' ')) reason.pop_back();
  for (char& c : reason)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return {engine::ErrorCode::kUnreadable,
          "'" + file.string() + "' cannot be read as a mesh" + (reason.empty() ? "." : " (" + reason + ")."),
          remedy()};
}

/// The processor time that a reader may take: seconds at least, and bytes for each further one. FBX takes a
/// tenth of that (2 MB in .2 s), glTF less; some damaged files keep their readers forever.
constexpr unsigned kLeast_s = 2;
constexpr std::uintmax_t kBytesPerSecond = 1'000'000;

/// Refuses a file that assimp does not survive.
engine::Result<void> check_survives(const std::filesystem::path& file, Format format) {
  if (traits_of(format).survives_damage) return {};
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  const auto most_s = kLeast_s + (error ? 0u : static_cast<unsigned>(size / kBytesPerSecond));
  const auto read = [&] {
    AssimpReader reader(format);
    Vec3 offset;
    parse(reader, file, offset);
  };
  const Ending ending = try_in_child(read, most_s);
  if (ending == Ending::kEnds) return {};
  return unreadable(file, ending == Ending::kCrashes ? "it is damaged, so that its reader crashes"
                                                     : "its reader does not come to an end");
}

/// What has none of the formats never reaches a reader.
engine::Result<Format> known_format(const std::filesystem::path& file) {
  const Format format = format_of(file);
  if (format != Format::kUnknown && format != Format::kBvh) return format;
  return engine::Error{engine::ErrorCode::kUnreadable,
                       "'" + file.string() + "' " +
                           (format == Format::kBvh ? "is a BVH file, which holds a motion and no mesh."
                                                   : "holds no " + std::string(kMeshFormats) + "."),
                       remedy()};
}

bool is_gltf(Format format) {
  return format == Format::kGltf || format == Format::kGlb;
}

/// The document of a glTF file, checked; empty for other formats.
engine::Result<std::optional<GltfDocument>> open_document(const std::filesystem::path& file, Format format) {
  if (!is_gltf(format)) return std::optional<GltfDocument>{};
  auto document = GltfDocument::open(file);
  if (!document) return unreadable(file, "it is no glTF 2 document");
  if (auto checked = check_gltf(*document, file); !checked) return checked.error();
  return document;
}

FileScene scene_of(FileMesh mesh, const std::filesystem::path& file) {
  FileScene scene;
  if (is_made_up(mesh.name)) mesh.name = file.stem().string();
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

}  // namespace

engine::Result<FileScene> read_motion_scene(const std::filesystem::path& file, LookOf look) {
  if (auto checked = check_readable(file); !checked) return checked.error();
  const auto format = known_format(file);
  if (!format) return format.error();
  auto document = open_document(file, *format);
  if (!document) return document.error();
  if (auto survives = check_survives(file, *format); !survives) return survives.error();
  AssimpReader reader(*format);
  Vec3 offset = Vec3::Zero();
  const aiScene* scene = parse(reader, file, offset);
  if (!scene || !scene->mRootNode) return unreadable(file, reader.importer().GetErrorString());

  FileScene result;
  result.kept_digits = !offset.isZero();
  Eigen::Matrix4d world_to_file = Eigen::Matrix4d::Identity();
  if (*format == Format::kCollada)
    world_to_file = undo_collada_unit(parse_collada_asset(read_text(file)), result);
  if (is_gltf(*format) || *format == Format::kColladaArchive) {
    result.meters_per_unit = 1.0;
    result.up = geometry::Axis::kY;
  }
  read_fbx_metadata(*scene, result);
  result.rig.world_to_file = world_to_file;
  Collector collector(*scene, std::move(*document), offset, result);
  const std::filesystem::path folder = file.parent_path();
  if (look == LookOf::kGarment) collector.read_looks(folder, has_materials(file, *format));
  collector.collect();
  for (FileMesh& mesh : result.meshes)
    if (is_made_up(mesh.name)) mesh.name = file.stem().string();
  if (traits_of(*format).splits_vertices)
    for (FileMesh& mesh : result.meshes) share_vertices(mesh);
  return result;
}

engine::Result<FileScene> read_scene(const std::filesystem::path& file, LookOf look) {
  if (look == LookOf::kNothing) {
    if (auto checked = check_readable(file); !checked) return checked.error();
    if (auto plain = read_plain_mesh(file, format_of(file))) return scene_of(std::move(*plain), file);
  }
  auto result = read_motion_scene(file, look);
  if (result && result->meshes.empty())
    return engine::Error{engine::ErrorCode::kUnreadable, "'" + file.string() + "' holds no triangles.",
                         "Export the body's surface as polygons, not as points, lines or curves."};
  return result;
}

}  // namespace bodice::io
