// Bodies with known truth, from files or made by synth.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

/// The 11 coarse classes of the data's labels; -1: unknown.
inline constexpr int kCoarseCount = 11;

/// The class that the data's labels would give a part.
int coarse_class(bodice::body::Part part);

struct Case {
  std::string name;
  bodice::geometry::TriMesh mesh;                             ///< repaired
  std::vector<int> truth;                                     ///< #V coarse class, empty if unknown
  std::map<std::string, bodice::geometry::Vec3> landmarks;    ///< LandmarkId names; empty if unknown
  double stature = 0.0;                                       ///< in the mesh's unit, 0 if unknown
  bool rest = false;                                          ///< stands as bodies are made: A or T pose
  std::string kind = {};                                      ///< the row of the report's table
  std::map<std::string, bodice::geometry::Vec3> joints = {};  ///< JointId names; those that are known
};

/// Every body of the data folder with `only` in its path. Sorted by name.
std::vector<Case> file_cases(const std::filesystem::path& data, const std::string& only);

/// The real bodies at rest, skinned to the skeletons of data/rigs and each brought into a random pose, with
/// the truth that its weights and bones give: seeds `from`, `from` + 1, ...
std::vector<Case> rig_cases(const std::filesystem::path& data, std::uint64_t from, std::uint64_t count);

/// Coarse class of each vertex of the bodies in data/bodies and data/rigs.
std::vector<int> body_labels(const std::filesystem::path& data);

/// A made body of random build (thin to obese; a child, pregnant), pose, resolution, rotation, position and
/// unit.
Case synth_case(std::uint64_t seed);

/// The average made body, as fine as wanted: what time is measured on.
bodice::geometry::TriMesh synth_mesh(int vertices);

}  // namespace bench
