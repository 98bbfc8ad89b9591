#include "batch/batch_options.hpp"

#include <algorithm>
#include <filesystem>

#include "options/garment_kinds.hpp"

namespace bodice::inline v0_1::cli {
namespace {

using engine::Error;
using engine::ErrorCode;

/// Options that a batch sets for all of its jobs, and the files that it names itself.
const std::set<std::string> kOfTheBatch = {"help",  "json",   "no_picture", "output",
                                           "quiet", "report", "threads"};
const std::set<std::string> kTakenFiles = {"body.glb",     "drape.glb",   "job.json",
                                           "proxy.bodice", "report.json", "thumbnail.png"};

Error refused(std::string message, std::string remedy) {
  return {ErrorCode::kInvalidArgument, std::move(message), std::move(remedy)};
}

std::string option_name(std::string key) {
  std::ranges::replace(key, '_', '-');
  return "--" + key;
}

/// Adds the words of an option that takes no value: none where it is false.
engine::Result<void> add_flag(const std::string& key, const std::vector<std::string>& values,
                              std::vector<std::string>& words) {
  const std::string value = values.size() == 1 ? values.front() : "";
  if (value == "true" || value == "1") {
    words.push_back(option_name(key));
  } else if (value != "false" && value != "0") {
    return refused("'" + key + "' is either true or false.", "Write one of them, or leave it out.");
  }
  return {};
}

engine::Result<void> check_output(const std::string& key, const std::vector<std::string>& values) {
  const std::string file = values.size() == 1 ? values.front() : "";
  const bool plain = !file.empty() && file.front() != '.' && file.find('/') == std::string::npos;
  if (plain && !kTakenFiles.contains(file)) return {};
  return refused("'" + key + "' cannot write '" + file + "'.",
                 "Give it the name of a file in the job's folder that the batch does not write itself.");
}

engine::Result<void> add_option(const CLI::App& options, const std::string& key,
                                const std::vector<std::string>& values, std::vector<std::string>& words) {
  if (kOfTheBatch.contains(key))
    return refused("'" + key + "' is not for one job.", "Leave it out: the batch sets it for all jobs.");
  const CLI::Option* const option = options.get_option_no_throw(option_name(key));
  if (!option || key.find('-') != std::string::npos)
    return refused(
        "'" + key + "' is none of the names of a job.",
        "They are body, garment, only, and the long options of `bodice drape --help` with underscores.");
  if (option->get_expected_max() == 0) return add_flag(key, values, words);
  if (option->get_group() == "Output")
    if (auto ok = check_output(key, values); !ok) return ok;
  if (option->get_items_expected_max() > 1 && option->get_delimiter() != ',') {
    for (const std::string& value : values) words.push_back(option_name(key) + "=" + value);
    return {};
  }
  std::string value;
  for (const std::string& part : values) value += (value.empty() ? "" : ",") + part;
  if (values.size() != 1 && option->get_delimiter() != ',')
    return refused("'" + key + "' takes one value.", "Write one, without brackets.");
  words.push_back(option_name(key) + "=" + value);
  return {};
}

/// Adds the words for the garments: files, or the kind of a made one.
engine::Result<void> add_garments(const batch::Job& job, std::vector<std::string>& words) {
  const auto found = job.values.find(kGarmentKey);
  if (found == job.values.end()) return {};
  const std::vector<std::string>& garments = found->second;
  if (garments.size() == 1 && garment_kinds().contains(garments.front())) {
    words.push_back("--garment=" + garments.front());
    return {};
  }
  if (!job.has(kBodyKey))
    return refused("A garment of a file needs a body of a file.",
                   "Give 'body', or leave the garment to be made.");
  words.insert(words.end(), garments.begin(), garments.end());
  return {};
}

engine::Result<void> check_only(const batch::Job& job, const CLI::App& options) {
  if (!job.has(kOnlyKey)) return {};
  if (!only_fits(job)) return refused("'only' is '" + job.value(kOnlyKey) + "'.", "It can be fit.");
  CLI::App of_fits;
  CommonOptions common;
  add_common_options(of_fits, common);
  const std::set<std::string> known = names_of_options(of_fits);
  for (const auto& [key, values] : job.values)
    if (key == kGarmentKey || (options.get_option_no_throw(option_name(key)) && !known.contains(key)))
      return refused("'" + key + "' has no effect on a job that only fits.", "Leave it or 'only' out.");
  return {};
}

}  // namespace

std::set<std::string> names_of_options(const CLI::App& options) {
  std::set<std::string> names;
  for (const CLI::Option* option : options.get_options())
    for (std::string name : option->get_lnames()) {
      std::ranges::replace(name, '-', '_');
      names.insert(std::move(name));
    }
  return names;
}

engine::Result<DrapeCommand> command_of(const batch::Job& job) {
  DrapeCommand command;
  CLI::App options{"", "bodice drape"};
  add_drape_options(options, command);
  std::vector<std::string> words = {"bodice", "drape"};
  if (job.has(kBodyKey)) {
    const std::vector<std::string>& bodies = job.values.at(kBodyKey);
    if (bodies.size() != 1) return refused("'body' takes one file.", "Write a job for each body.");
    words.push_back(bodies.front());
  }
  if (auto ok = check_only(job, options); !ok) return std::move(ok).error();
  if (auto ok = add_garments(job, words); !ok) return std::move(ok).error();
  for (const auto& [key, values] : job.values) {
    if (key == kBodyKey || key == kGarmentKey || key == kOnlyKey) continue;
    if (auto ok = add_option(options, key, values, words); !ok) return std::move(ok).error();
  }
  std::vector<const char*> arguments;
  for (std::size_t i = 1; i < words.size(); ++i) arguments.push_back(words[i].c_str());
  try {
    options.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::Error& error) {
    return refused(std::string(error.what()) + ".", "`bodice drape --help` explains each option.");
  }
  if (only_fits(job)) words[1] = "fit";
  command.common.command_line = std::move(words);
  command.common.quiet = true;
  return command;
}

}  // namespace bodice::cli
