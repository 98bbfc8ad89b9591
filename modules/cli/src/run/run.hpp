// The common steps of fit and drape: set up, segment, choose the region, write the outputs.
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
#include <bodice/tryon/rigged_body.hpp>

#include "options/options.hpp"
#include "output/outputs.hpp"
#include "output/terminal.hpp"

namespace bodice::inline v0_1::cli {

/// One run of a command: its executor, trace and progress line.
class Run {
 public:
  explicit Run(const CommonOptions& options);

  const engine::Context& context() const { return context_; }
  const CommonOptions& options() const { return options_; }
  ProgressLine& progress() { return progress_; }

  /// Calls check_outputs() with the shared and the given outputs and inputs.
  engine::Result<void> check_files(std::vector<FileOption> outputs,
                                   std::vector<FileOption> inputs = {}) const;
  engine::Result<tryon::SegmentedSkin> segment();
  /// The same with a rig: that of the file, of the built-in body, or a found one.
  engine::Result<tryon::SegmentedSkin> segment_rigged();
  /// The garment of --region-of in the skin's frame; empty if none was given.
  engine::Result<std::vector<geometry::TriMesh>> region_garments(const tryon::SegmentedSkin& skin);
  /// The options of the fit, limited to the parts near `garments` if there are any.
  engine::Result<fitting::FitOptions> fit_options_for(const tryon::SegmentedSkin& skin,
                                                      std::span<const geometry::TriMesh> garments);
  /// Writes labels, report and trace as requested, and prints the summary or the report. `cropped`: the proxy
  /// was reduced after it was measured.
  engine::Result<void> finish(const tryon::PreparedBody& body, const tryon::DrapeReport* drape,
                              const std::vector<std::string>& written, bool cropped = false);
  /// Writes the page of --html if it was given, and adds it to `written`.
  engine::Result<void> write_page(const tryon::PreparedBody& body, const io::Scene& scene,
                                  const tryon::DrapeReport* drape, std::vector<std::string>& written);
  /// Prints one line a file, unless --quiet was given.
  void list_written(const std::vector<std::string>& files);

 private:
  std::string report(const tryon::PreparedBody& body, const tryon::DrapeReport* drape, bool cropped) const;
  const CommonOptions& options_;
  std::unique_ptr<engine::Executor> executor_;  ///< null for one worker: this thread
  std::unique_ptr<engine::Trace> trace_;
  engine::Context context_;
  ProgressLine progress_;
};

/// Pictures in lists of results.
inline constexpr io::PictureOptions kThumbnail = {.width = 120, .height = 180};

/// The body, its parts and its proxy as a scene for output.
io::Scene scene_of(const tryon::PreparedBody& body);

}  // namespace bodice::cli
