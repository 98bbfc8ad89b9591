// Preprocessing from end to end: from a body file to landmarks, parts and a proxy.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/io/import.hpp>
#include <bodice/rig/rig.hpp>
#include <bodice/synth/body.hpp>

namespace bodice::inline v0_1::tryon {

/// Called as long work proceeds, with a stage's name and the fraction of it that is done, 0..1. Calls come
/// from one thread.
using Progress = std::function<void(std::string_view stage, double fraction)>;

/// A body with a part for every vertex of its skin, for fitting and garment making.
struct SegmentedSkin {
  io::ImportedMesh input;
  anatomy::Anatomy anatomy;
  std::shared_ptr<const geometry::MeshDistance> distance;  ///< exact distance to input.skin
  std::shared_ptr<const rig::Rig> rig;  ///< the rig of input.skin, null where there is none
  std::vector<engine::StageTime> stages;
  std::vector<engine::Warning> warnings;  ///< warnings of import and anatomy
};

/// A segmented body and its proxy.
struct PreparedBody {
  SegmentedSkin skin;
  fitting::FitResult fit;

  /// All warnings, and the times of all stages, those of segmentation before those of the fit.
  std::vector<engine::Warning> all_warnings() const;
  std::vector<engine::StageTime> all_stages() const;
};

/// How a body is read and analyzed.
struct SegmentOptions {
  io::ImportOptions import;
  std::optional<body::ProportionProfile> profile;  ///< absent: "ansur2"
  bool force = false;                              ///< as in anatomy::Options
};

/// Reads a body file and segments it. Fails as io::import_body() and anatomy::analyze() do; errors name the
/// file and the remedy. Cost: that of these two; about .2 s of one core for 8,500 vertices.
engine::Result<SegmentedSkin> segment_file(const engine::Context& context, const std::filesystem::path& file,
                                           const SegmentOptions& options, const Progress& progress = {});

/// Makes the built-in body and segments it like any other; its known landmarks and parts are not used.
engine::Result<SegmentedSkin> segment_builtin(const engine::Context& context, const synth::BodyOptions& body,
                                              const SegmentOptions& options, const Progress& progress = {});

/// Repairs a mesh in memory, in meters with y up, for segment_mesh(). Fails as geometry::repair() does.
engine::Result<io::ImportedMesh> repair_body(const engine::Context& context, const geometry::TriMesh& mesh);

/// Segments a repaired mesh in memory. Cost: that of anatomy::analyze().
engine::Result<SegmentedSkin> segment_mesh(const engine::Context& context, io::ImportedMesh input,
                                           const SegmentOptions& options, const Progress& progress = {});

/// A view of the skin in the form that fitting needs. It refers to `skin` and is valid as long as `skin`.
fitting::LabeledSkin labeled(const SegmentedSkin& skin);

/// Fits a proxy to a segmented skin. Fails as fitting::fit() does. Cost for 89 ellipsoids on two cores: 13 ms
/// with tier solid, 0.8 s with tight, 1.5 s with relief (bench/README.md).
engine::Result<PreparedBody> fit_proxy(const engine::Context& context, SegmentedSkin skin,
                                       const fitting::FitOptions& options, const Progress& progress = {});

/// The same for a body that will move: ellipsoids are found on the flexed skin, and the proxy is bound to the
/// skin's rig. Without a rig it is fit_proxy(). Fails as fit_proxy() and binding::bind() do. Cost: that of
/// both.
engine::Result<PreparedBody> fit_bound_proxy(const engine::Context& context, SegmentedSkin skin,
                                             fitting::FitOptions options, const Progress& progress = {});

}  // namespace bodice::tryon
