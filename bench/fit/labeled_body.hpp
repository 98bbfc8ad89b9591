// Bodies with a true label for each vertex, from OBJ files or made, so that fits are judged without the layer
// anatomy.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace fit_bench {

/// A body mesh with its parts.
struct LabeledBody {
  bodice::geometry::TriMesh mesh;
  std::vector<bodice::body::Part> part;  ///< #V
  double stature_m = 0.0;
};

/// Reads a body; nothing if that fails. `labels` has one fine class for each vertex (head, neck, upper_torso,
/// lower_torso, l_upper_arm, ...). The torso's two classes are split into six parts at thirds of its height
/// and at its middle plane.
std::optional<LabeledBody> load(const std::filesystem::path& obj, const std::filesystem::path& labels);

/// A made body from which no constant was derived: sex, mass and pose follow from the seed.
std::optional<LabeledBody> make_synthetic(std::uint64_t seed);

}  // namespace fit_bench
