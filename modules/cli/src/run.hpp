// What fit and drape do alike: set up, segment, choose the region, write what was asked for.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/trace.hpp>
#include <bodice/io/scene.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/report.hpp>

#include "options.hpp"
#include "outputs.hpp"
#include "terminal.hpp"

namespace bodice::cli {

/// One run of a command: its executor, trace and progress line.
class Run {
 public:
  explicit Run(const CommonOptions& options);

  const engine::Context& context() const { return context_; }
  const CommonOptions& options() const { return options_; }
  ProgressLine& progress() { return progress_; }

  /// check_outputs() of the shared outputs and a command's own, against the shared inputs and its own.
  engine::Result<void> check_files(std::vector<FileOption> outputs,
                                   std::vector<FileOption> inputs = {}) const;
  engine::Result<tryon::SegmentedSkin> segment();
  /// The garment of --region-of, where the skin is; empty when none was given.
  engine::Result<std::vector<geometry::TriMesh>> region_garments(const tryon::SegmentedSkin& skin);
  /// The fit's options, with only the parts near `garments` when there are any.
  engine::Result<fitting::FitOptions> fit_options_for(const tryon::SegmentedSkin& skin,
                                                      std::span<const geometry::TriMesh> garments);
  /// Writes labels, report and trace, where asked for, and prints the summary or the report. `cropped`: the
  /// proxy was cut down after it was measured.
  engine::Result<void> finish(const tryon::PreparedBody& body, const tryon::DrapeReport* drape,
                              const std::vector<std::string>& written, bool cropped = false);
  /// One line a file, unless the user asked for quiet.
  void list_written(const std::vector<std::string>& files);

 private:
  const CommonOptions& options_;
  std::unique_ptr<engine::Executor> executor_;
  std::unique_ptr<engine::Trace> trace_;
  engine::Context context_;
  ProgressLine progress_;
};

/// The body, its parts and its proxy as output sees them.
io::Scene scene_of(const tryon::PreparedBody& body);

}  // namespace bodice::cli
