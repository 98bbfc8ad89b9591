// Makes the coefficients of anatomy again from made bodies of known truth and, with --data, from those of a
// data folder, and writes each to DIR/<name>.json: those in use, or those that are named. The same command
// writes the same files. modules/anatomy/data/README.md states what is made by which command, and how good it
// is.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <bench_support/help.hpp>

#include "fit.hpp"
#include "fit_corrections.hpp"
#include "fit_fold_levels.hpp"
#include "fit_joint_offsets.hpp"
#include "fit_lengths.hpp"
#include "fit_own_signatures.hpp"
#include "fit_part_borders.hpp"
#include "landmarks/landmark_table.hpp"

namespace {

using bodice::anatomy::LandmarkKind;
using bodice::anatomy::Recipe;
using calibrate::ordered_json;
using calibrate::Samples;

/// Seeds that no test and no other bench makes bodies of.
constexpr std::uint64_t kFirstSeed = 910000, kFirstStandingSeed = 930000;

/// The values of the command line.
struct Arguments {
  std::filesystem::path folder, data;
  std::string only;
  std::size_t bodies = 300;

  bool names(const std::string& name) const {
    return ("," + only + ",").find("," + name + ",") != std::string::npos;
  }
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (more && std::strcmp(argv[i], "--bodies") == 0)
      a.bodies = std::stoull(argv[++i]);
    else if (more && std::strcmp(argv[i], "--only") == 0)
      a.only = argv[++i];
    else if (more && std::strcmp(argv[i], "--data") == 0)
      a.data = argv[++i];
    else
      a.folder = argv[i];
  }
  return a;
}

std::string file_of(const LandmarkKind& kind) {
  const std::string_view name = bodice::body::name(kind.id);
  return std::string(kind.paired ? name.substr(0, name.size() - 2) : name);
}

/// Bodies of known truth, made or read when they are first needed.
class Bodies {
 public:
  explicit Bodies(const Arguments& arguments) : arguments_(arguments) {}

  /// Returns the made bodies in all poses.
  Samples posed() {
    if (posed_.empty()) posed_ = calibrate::make_samples({kFirstSeed, arguments_.bodies, false});
    return seen(posed_);
  }
  /// Returns the made bodies with an upright trunk.
  Samples standing() {
    if (standing_.empty()) standing_ = calibrate::make_samples({kFirstStandingSeed, arguments_.bodies, true});
    return seen(standing_);
  }
  /// Returns the same with the upright ones, and each body once.
  Samples each_once() {
    read();
    Samples each = posed();
    for (const Samples& more : {standing(), seen(read_)}) each.insert(each.end(), more.begin(), more.end());
    return each;
  }
  /// Returns the made bodies in all poses and, if a data folder is given, as many bodies of its people.
  Samples all() {
    read();
    Samples both = posed();
    for (const calibrate::Sample* sample : seen(read_)) both.insert(both.end(), sample->weight(), sample);
    return both;
  }

 private:
  void read() {
    if (!arguments_.data.empty() && read_.empty())
      read_ = calibrate::read_samples(arguments_.data, arguments_.bodies);
  }
  static Samples seen(const calibrate::OwnedSamples& owned) {
    Samples samples;
    for (const auto& sample : owned) samples.push_back(sample.get());
    return samples;
  }

  const Arguments& arguments_;
  calibrate::OwnedSamples posed_, standing_, read_;
};

ordered_json fit(const LandmarkKind& kind, Bodies& bodies) {
  switch (kind.recipe) {
    case Recipe::kSignature:
      return fit_signature(kind, bodies.posed());
    case Recipe::kTrunkLevel:
      return fit_trunk_level(kind, bodies.standing());
    case Recipe::kLimbLevel:
      return fit_limb_level(kind, bodies.posed());
    case Recipe::kCorrections:
    case Recipe::kNone:
      break;
  }
  return {};
}

/// Returns the contents of a coefficient file, with the members in `made` replaced.
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

/// Fits that no recipe of a landmark names. They are made only if they are named, since what is fitted after
/// them reads what they make: the library has to be built in between.
struct OwnFit {
  const char* name;
  const char* file;
  ordered_json (*fit)(const calibrate::Samples& samples);
  bool standing = false;  ///< also by made bodies with an upright trunk
};
constexpr OwnFit kOwnFits[] = {{"stature", "stature", calibrate::fit_stature},
                               {"extremities", "extremities", calibrate::fit_extremities},
                               {"part_borders", "part_borders", calibrate::fit_part_borders},
                               {"joint_borders", "joint_borders", calibrate::fit_joint_borders},
                               {"joint_offsets", "joint_offsets", calibrate::fit_joint_offsets},
                               {"fold_levels", "fold_levels", calibrate::fit_fold_levels, true},
                               {"perineum_signature", "perineum", calibrate::fit_perineum_signature, true},
                               {"armpit_signature", "armpit", calibrate::fit_armpit_signature, true}};

constexpr const char* kUsage =
    "calibrate DIR [--bodies N] [--only NAME,NAME] [--data BODIES]\n"
    "Makes coefficients of anatomy again, and writes each to DIR/NAME.json: those that made bodies alone "
    "give, "
    "or those that are named. perineum_signature and armpit_signature are written to perineum and armpit. "
    "Borders come first, then signatures, then corrections, with a build of the library in between.\n";

}  // namespace

int main(int argc, char** argv) {
  if (bench::help_requested(argc, argv, kUsage)) return 0;
  const Arguments a = parse(argc, argv);
  if (!std::filesystem::is_directory(a.folder)) {
    std::fprintf(
        stderr,
        "usage: calibrate DIR [--bodies N] [--only NAME,NAME] [--data BODIES], DIR: an existing folder "
        "for the files\n");
    return 2;
  }
  Bodies bodies(a);
  for (const OwnFit& own : kOwnFits) {
    if (!a.names(own.name)) continue;
    const Samples samples = own.standing ? bodies.each_once() : bodies.all();
    if (!make_again(a.folder, own.file, own.fit(samples))) return 1;
  }
  std::vector<const LandmarkKind*> corrected;
  for (const LandmarkKind& kind : bodice::anatomy::landmark_kinds()) {
    const std::string name = file_of(kind);
    const bool taken = kind.recipe != Recipe::kNone && kind.recipe != Recipe::kCorrections;
    if (kind.recipe == Recipe::kCorrections && a.names(name)) corrected.push_back(&kind);
    if (!taken || !(a.names(name) || a.only.empty())) continue;
    if (!make_again(a.folder, name, fit(kind, bodies))) return 1;
  }
  if (corrected.empty()) return 0;
  for (const auto& [kind, made] : calibrate::fit_corrections(corrected, bodies.each_once()))
    if (!make_again(a.folder, file_of(*kind), made)) return 1;
  return 0;
}
