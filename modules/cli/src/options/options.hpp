// The options that fit and drape share, as they stand on the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::cli {

inline constexpr int kExitOk = 0, kExitFailed = 1, kExitUsage = 2;

/// Input, fit and output. Paths are empty when the option was not given.
struct CommonOptions {
  std::string body;  ///< a file; empty: the built-in body
  std::string up = "auto", unit = "auto", mesh, profile = "ansur2", shape = "person";
  int person = 1;
  bool force = false, keep_noise = false, keep_vertices = false;

  std::string sex = "female", pose = "a";
  double height_m = 1.68;
  std::optional<double> mass_kg;  ///< absent: the usual one of the height
  int vertices = 8850;

  std::string tier;
  std::optional<double> time_budget_s, target_error_mm, budget_us, mu_torso_mm, mu_limbs_mm;
  std::optional<int> max_ellipsoids;
  std::string region_of;
  double region_margin_mm = 50.0;

  int threads = 0;
  std::uint64_t seed = 0;

  std::string labels, glb, report, html, trace, picture;
  bool json = false, quiet = false;
  std::vector<std::string> command_line;  ///< for the report
};

/// Adds the shared options to a subcommand, grouped as its help shows them.
void add_common_options(CLI::App& command, CommonOptions& options);
/// `help` states what the body is for; the formats of its file and the default follow.
CLI::Option* add_body_option(CLI::App& command, CommonOptions& options, const std::string& help);
/// Adds options that refer to BODY, which has to be added before.
void add_input_options(CLI::App& command, CommonOptions& options);
void add_builtin_options(CLI::App& command, CommonOptions& options);
void add_run_options(CLI::App& command, CommonOptions& options);

/// The options in the form of the library. Errors name the option and its values.
engine::Result<tryon::SegmentOptions> segment_options(const CommonOptions& options);
engine::Result<synth::BodyOptions> builtin_body(const CommonOptions& options);
fitting::FitOptions fit_options(const CommonOptions& options);

void add_fit_command(CLI::App& app, int& exit_code, const std::vector<std::string>& command_line);
void add_drape_command(CLI::App& app, int& exit_code, const std::vector<std::string>& command_line);
void add_make_command(CLI::App& app, int& exit_code);
void add_rig_command(CLI::App& app, int& exit_code);
void add_query_command(CLI::App& app, int& exit_code);
void add_export_command(CLI::App& app, int& exit_code);
void add_report_command(CLI::App& app, int& exit_code);
void add_batch_command(CLI::App& app, int& exit_code);
void add_bench_command(CLI::App& app, int& exit_code, const std::string& program);

}  // namespace bodice::cli
