// calibrate DIR [--bodies N] [--only NAME]
// Makes the coefficients of anatomy's landmarks again from made bodies of known truth, and writes each
// landmark's to DIR/<name>.json. The same command writes the same files. modules/anatomy/data/README.md
// states what is made by which command, and how good it is.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "fit.hpp"
#include "fit_corrections.hpp"
#include "fit_lengths.hpp"
#include "landmarks/landmark_table.hpp"

namespace {

using bodice::anatomy::LandmarkKind;
using bodice::anatomy::Recipe;
using calibrate::ordered_json;

/// Seeds that no test and no other bench makes bodies of.
constexpr std::uint64_t kFirstSeed = 910000, kFirstStandingSeed = 930000;

/// The values of the command line.
struct Arguments {
  std::filesystem::path folder;
  std::string only;
  std::size_t bodies = 300;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (more && std::strcmp(argv[i], "--bodies") == 0)
      a.bodies = std::stoull(argv[++i]);
    else if (more && std::strcmp(argv[i], "--only") == 0)
      a.only = argv[++i];
    else
      a.folder = argv[i];
  }
  return a;
}

std::string file_of(const LandmarkKind& kind) {
  const std::string_view name = bodice::body::name(kind.id);
  return std::string(kind.paired ? name.substr(0, name.size() - 2) : name);
}

ordered_json fit(const LandmarkKind& kind, const calibrate::Samples& samples) {
  switch (kind.recipe) {
    case Recipe::kSignature:
      return fit_signature(kind, samples);
    case Recipe::kTrunkLevel:
      return fit_trunk_level(kind, samples);
    case Recipe::kLimbLevel:
      return fit_limb_level(kind, samples);
    case Recipe::kCorrections:
      return fit_corrections(kind, samples);
    case Recipe::kNone:
      break;
  }
  return {};
}

/// What a file holds, with the members that were made again.
ordered_json replaced(const std::filesystem::path& file, const ordered_json& made) {
  std::ifstream in(file);
  ordered_json all = in ? ordered_json::parse(in) : ordered_json::object();
  for (const auto& [member, numbers] : made.items()) all[member] = numbers;
  return all;
}

/// One member a line, numbers separated by spaces.
bool write(const std::filesystem::path& file, const calibrate::ordered_json& coefficients) {
  std::ofstream out(file);
  out << "{";
  const char* separator = "\n";
  for (const auto& [name, numbers] : coefficients.items()) {
    out << separator << "  \"" << name << "\": [";
    for (std::size_t i = 0; i < numbers.size(); ++i)
      out << (i == 0 ? "\n    " : i % 8 == 0 ? ",\n    " : ", ") << numbers[i].dump();
    out << "\n  ]";
    separator = ",\n";
  }
  out << "\n}\n";
  return static_cast<bool>(out);
}

/// Replaces members of a file. False if it cannot be written.
bool make_again(const std::filesystem::path& folder, const std::string& name, const ordered_json& made) {
  const std::filesystem::path file = folder / (name + ".json");
  if (!write(file, replaced(file, made))) {
    std::fprintf(stderr, "could not write %s\n", file.c_str());
    return false;
  }
  std::printf("wrote %s.json\n", name.c_str());
  return true;
}

/// Fits that no recipe of a landmark names.
struct OwnFit {
  const char* name;
  ordered_json (*fit)(const calibrate::Samples& samples);
};
constexpr OwnFit kOwnFits[] = {{"stature", calibrate::fit_stature},
                               {"extremities", calibrate::fit_extremities},
                               {"perineum", calibrate::fit_perineum_signature},
                               {"armpit", calibrate::fit_armpit_signature}};

}  // namespace

int main(int argc, char** argv) {
  const Arguments a = parse(argc, argv);
  if (!std::filesystem::is_directory(a.folder)) {
    std::fprintf(stderr,
                 "usage: calibrate DIR [--bodies N] [--only NAME], DIR: an existing folder for the files\n");
    return 2;
  }
  calibrate::Samples posed, standing;
  for (const auto& [name, fit] : kOwnFits)
    if (a.only.empty() || a.only == name) {
      if (posed.empty()) posed = calibrate::make_samples({kFirstSeed, a.bodies, false});
      if (!make_again(a.folder, name, fit(posed))) return 1;
    }
  for (const LandmarkKind& kind : bodice::anatomy::landmark_kinds()) {
    const std::string name = file_of(kind);
    if (kind.recipe == Recipe::kNone || (!a.only.empty() && a.only != name)) continue;
    if (kind.recipe == Recipe::kTrunkLevel && standing.empty())
      standing = calibrate::make_samples({kFirstStandingSeed, a.bodies, true});
    if (kind.recipe != Recipe::kTrunkLevel && posed.empty())
      posed = calibrate::make_samples({kFirstSeed, a.bodies, false});
    if (!make_again(a.folder, name, fit(kind, kind.recipe == Recipe::kTrunkLevel ? standing : posed)))
      return 1;
  }
  return 0;
}
