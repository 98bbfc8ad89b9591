// Finds a body's unit and up axis by its shape.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::io {

struct DetectedFrame {
  geometry::Frame frame;
  std::string unit;
  bool up_found_by_extents = false;
  std::vector<engine::Warning> warnings;
};

/// The user's unit and axis are used if given; then those of the file, if they make a plausible body; then
/// the shape.
DetectedFrame detect_frame(const geometry::TriMesh& body, const ImportOptions& options,
                           std::optional<double> meters_per_unit, std::optional<geometry::Axis> up);

/// The same of a thing; its shape shows neither: what is not given is meters, with a warning, and y up.
DetectedFrame frame_of_thing(const geometry::TriMesh& thing, const ImportOptions& options,
                             std::optional<double> meters_per_unit, std::optional<geometry::Axis> up);

/// The axis along which a body stands, by its extents, its mirror symmetry and its soles. Where the shape
/// does not decide, it is y.
geometry::Axis up_axis_of(const geometry::TriMesh& body);

/// The name of a unit of this length, or "unknown".
std::string unit_name(double meters);

}  // namespace bodice::io
