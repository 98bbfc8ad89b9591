// Which unit a body is measured in and which way is up, from its shape.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/io/import.hpp>

namespace bodice::io {

struct DetectedFrame {
  geometry::Frame frame;
  std::string unit;
  std::vector<engine::Warning> warnings;
};

/// What the user says holds; then what the file says, while it gives a plausible body; then the shape.
DetectedFrame detect_frame(const geometry::TriMesh& body, const ImportOptions& options,
                           std::optional<double> meters_per_unit, std::optional<geometry::Axis> up);

/// The axis a body stands along, judged by its extents, its mirror symmetry and its soles. Files of unknown
/// convention are taken as y up where the shape does not tell.
geometry::Axis up_axis_of(const geometry::TriMesh& body);

/// The name of a unit of this length, or "unknown".
std::string unit_name(double meters);

}  // namespace bodice::io
