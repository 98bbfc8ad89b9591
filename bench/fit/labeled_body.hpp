// Bodies with true labels a vertex, from OBJ files or made, for judging fits without the anatomy layer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace fit_bench {

struct LabeledBody {
  bodice::geometry::TriMesh mesh;
  std::vector<bodice::body::Part> part;  ///< #V
  double stature_m = 0.0;
};

/// `labels` holds one fine class a vertex (head, neck, upper_torso, lower_torso, l_upper_arm, ...). The
/// torso's two classes are cut into six parts at thirds of its height and at its middle plane.
std::optional<LabeledBody> load(const std::filesystem::path& obj, const std::filesystem::path& labels);

/// A parametric body that nothing was developed on: sex, mass and pose follow from the seed.
std::optional<LabeledBody> make_synthetic(std::uint64_t seed);

}  // namespace fit_bench
