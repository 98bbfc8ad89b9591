// Preprocessing from end to end: a body file in, landmarks, parts and a proxy out.
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
#include <bodice/synth/body.hpp>

namespace bodice::tryon {

/// Told where long work stands: a stage's name and the fraction done of it, 0..1. Called from one thread.
using Progress = std::function<void(std::string_view stage, double fraction)>;

/// A body whose skin is known by part: all that fitting and garment making need.
struct SegmentedSkin {
  io::ImportedMesh input;
  anatomy::Anatomy anatomy;
  std::shared_ptr<const geometry::MeshDistance> distance;  ///< exact, of input.skin
  std::vector<engine::StageTime> stages;
  std::vector<engine::Warning> warnings;  ///< of import and anatomy
};

/// A segmented body and its proxy.
struct PreparedBody {
  SegmentedSkin skin;
  fitting::FitResult fit;

  std::vector<engine::Warning> all_warnings() const;
  std::vector<engine::StageTime> all_stages() const;
};

struct SegmentOptions {
  io::ImportOptions import;
  std::optional<body::ProportionProfile> profile;  ///< absent: "ansur2"
};

/// Reads a body file and segments it. Errors name the file and the remedy.
engine::Result<SegmentedSkin> segment_file(const engine::Context& context, const std::filesystem::path& file,
                                           const SegmentOptions& options, const Progress& progress = {});

/// Makes the built-in body and segments it like any other: its truth is not used.
engine::Result<SegmentedSkin> segment_builtin(const engine::Context& context, const synth::BodyOptions& body,
                                              const SegmentOptions& options, const Progress& progress = {});

/// Segments a mesh that is already in memory and repaired.
engine::Result<SegmentedSkin> segment_mesh(const engine::Context& context, io::ImportedMesh input,
                                           const SegmentOptions& options, const Progress& progress = {});

/// The skin as fitting takes it; valid as long as the skin.
fitting::LabeledSkin labeled(const SegmentedSkin& skin);

/// Fits a proxy to a segmented skin.
engine::Result<PreparedBody> fit_proxy(const engine::Context& context, SegmentedSkin skin,
                                       const fitting::FitOptions& options, const Progress& progress = {});

}  // namespace bodice::tryon
