// The names and values of a job as the command line of `drape`.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <bodice/batch/job.hpp>

#include "run/drape_steps.hpp"

namespace bodice::inline v0_1::cli {

inline constexpr const char* kBodyKey = "body";
inline constexpr const char* kGarmentKey = "garment";
inline constexpr const char* kOnlyKey = "only";

/// Whether a job stops at the proxy.
inline bool only_fits(const batch::Job& job) {
  return job.value(kOnlyKey) == "fit";
}

/// The names by which jobs give the options of an option parser: long ones, with underscores.
std::set<std::string> names_of_options(const CLI::App& options);

/// The job's options as the parser of `drape` reads and checks them. `common.command_line` holds the words
/// that repeat the job alone. Outputs are names of files in the job's folder. Fails with kInvalidArgument;
/// the sentence names the option.
engine::Result<DrapeCommand> command_of(const batch::Job& job);

}  // namespace bodice::cli
