#include "options/options.hpp"

#include <filesystem>
#include <limits>
#include <map>

#include <bodice/body/proportions.hpp>

#include "options/validators.hpp"

namespace bodice::inline v0_1::cli {
namespace {

const std::map<std::string, io::Unit> kUnits = {{"auto", io::Unit::kAuto},     {"m", io::Unit::kMeter},
                                                {"dm", io::Unit::kDecimeter},  {"cm", io::Unit::kCentimeter},
                                                {"mm", io::Unit::kMillimeter}, {"in", io::Unit::kInch},
                                                {"ft", io::Unit::kFoot}};

const std::map<std::string, synth::Pose> kPoses = {{"a", synth::Pose::kA},
                                                   {"t", synth::Pose::kT},
                                                   {"arms-down", synth::Pose::kArmsDown},
                                                   {"arms-up", synth::Pose::kArmsUp},
                                                   {"stride", synth::Pose::kStride},
                                                   {"sit", synth::Pose::kSit},
                                                   {"squat", synth::Pose::kSquat},
                                                   {"run", synth::Pose::kRun},
                                                   {"kick", synth::Pose::kKick},
                                                   {"lying", synth::Pose::kLying},
                                                   {"handstand", synth::Pose::kHandstand},
                                                   {"random", synth::Pose::kRandom}};

template <class Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

constexpr const char* kAccuracyGroup = "Speed against accuracy";

/// The options that choose between speed and accuracy, of which at most one is given.
struct LimitOptions {
  CLI::Option* error;
  CLI::Option* count;
  CLI::Option* budget;
};

LimitOptions add_limit_options(CLI::App& command, CommonOptions& o) {
  auto* error =
      command
          .add_option("--target-error-mm", o.target_error_mm, "mean distance between proxy and skin to reach")
          ->check(above_zero())
          ->group(kAccuracyGroup);
  auto* count = command
                    .add_option("--max-ellipsoids", o.max_ellipsoids,
                                "at most this many ellipsoids (solid: never more than 200)")
                    ->check(whole(1, 4096))
                    ->group(kAccuracyGroup);
  auto* budget =
      command
          .add_option(
              "--budget-us", o.budget_us,
              "time of one query of 10,000 particles near the skin, microseconds, on one thread of a 2.5 GHz "
              "server; measured here afterwards, so that you can scale it")
          ->check(above_zero())
          ->group(kAccuracyGroup);
  error->excludes(count)->excludes(budget);
  count->excludes(budget);
  return {error, count, budget};
}

void add_threshold_options(CLI::App& command, CommonOptions& o, const LimitOptions& limits) {
  auto* torso =
      command
          .add_option(
              "--mu-torso-mm", o.mu_torso_mm,
              "the paper's threshold for the torso, with the tiers paper (then the default) and solid "
              "(default: automatic)")
          ->check(above_zero())
          ->group(kAccuracyGroup);
  auto* limbs = command
                    .add_option("--mu-limbs-mm", o.mu_limbs_mm,
                                "the paper's threshold for head and limbs (default: automatic)")
                    ->check(above_zero())
                    ->group(kAccuracyGroup);
  torso->needs(limbs)->excludes(limits.error)->excludes(limits.budget);
  limbs->needs(torso)->excludes(limits.error)->excludes(limits.budget);
}

void add_region_options(CLI::App& command, CommonOptions& o) {
  command
      .add_option(
          "--region-of", o.region_of,
          "fit only the parts that this garment can touch: paper and solid give them the ellipsoids of the "
          "whole body's fit, tight and relief others that are as accurate")
      ->check(not_empty())
      ->group(kAccuracyGroup);
  command.add_option("--region-margin-mm", o.region_margin_mm, "how far that garment can reach")
      ->check(zero_or_more())
      ->needs("--region-of")
      ->group(kAccuracyGroup)
      ->capture_default_str();
}

void add_fit_options(CLI::App& command, CommonOptions& o) {
  command
      .add_option("--tier", o.tier,
                  "paper (as published), solid (no leaks), tight (about a millimeter from the skin), relief "
                  "(about a fifth of one; the default)")
      ->check(CLI::IsMember({"paper", "solid", "tight", "relief"}))
      ->group(kAccuracyGroup)
      ->capture_default_str();
  add_threshold_options(command, o, add_limit_options(command, o));
  command
      .add_option(
          "--time-budget-s", o.time_budget_s,
          "stop refining after this long, with a warning (default: after a fixed number of steps; runs "
          "repeat to the bit)")
      ->check(above_zero())
      ->group(kAccuracyGroup);
  add_region_options(command, o);
}

void add_output_options(CLI::App& command, CommonOptions& o) {
  const auto group = "Output";
  command.add_option("--labels", o.labels, "write `x y z part` for each welded vertex")
      ->check(not_empty())
      ->group(group);
  command
      .add_option("--html", o.html,
                  "write a page to look at, one file that needs no network: the body to turn, its error in "
                  "color, cloth over time")
      ->check(not_empty())
      ->group(group);
  command.add_option("--report", o.report, "write the report, one JSON object")
      ->check(not_empty())
      ->group(group);
  command.add_option("--picture", o.picture, "write a PNG from two sides")->check(not_empty())->group(group);
  command.add_option("--trace", o.trace, "write a Chrome trace (open in Perfetto)")
      ->check(not_empty())
      ->group(group);
  command.add_flag("--json", o.json, "print the report to standard output instead of a summary")
      ->group(group);
}

engine::Result<body::ProportionProfile> proportions(const CommonOptions& o) {
  const bool is_file = o.profile.ends_with(".json") || std::filesystem::exists(o.profile);
  return is_file ? body::load_profile(o.profile) : body::find_profile(o.profile);
}

}  // namespace

void add_input_options(CLI::App& command, CommonOptions& o) {
  const auto group = "Input";
  command.add_option("--unit", o.unit, "length unit of the file: m, dm, cm, mm, in, ft, auto")
      ->check(CLI::IsMember(keys(kUnits)))
      ->needs("BODY")
      ->group(group)
      ->capture_default_str();
  command.add_option("--up", o.up, "up axis of the file: x, y, z, auto")
      ->check(CLI::IsMember({"x", "y", "z", "auto"}))
      ->needs("BODY")
      ->group(group)
      ->capture_default_str();
  command.add_option("--mesh", o.mesh, "take this mesh of the file for the body (default: chosen by shape)")
      ->check(not_empty())
      ->needs("BODY")
      ->group(group);
  command
      .add_option("--person", o.person, "which body of a file with several people, from 1 (the most likely)")
      ->check(whole(1, 1000))
      ->needs("BODY")
      ->group(group)
      ->capture_default_str();
  command.add_flag("--keep-noise", o.keep_noise, "do not smooth the noise of a scan")
      ->needs("BODY")
      ->group(group);
  command.add_flag("--keep-vertices", o.keep_vertices, "do not thin a body of more than 300,000 vertices")
      ->needs("BODY")
      ->group(group);
  command.add_flag("--force", o.force, "go on with a warning where the shape contradicts a human body")
      ->needs("BODY")
      ->group(group);
  command.add_option("--profile", o.profile, "body proportions: ansur2, gb10000-88 or a JSON file")
      ->check(profile())
      ->group(group)
      ->capture_default_str();
}

void add_builtin_options(CLI::App& command, CommonOptions& o) {
  const auto group = "Built-in body (without BODY)";
  command.add_option("--sex", o.sex, "female, male")
      ->check(CLI::IsMember({"female", "male"}))
      ->excludes("BODY")
      ->group(group)
      ->capture_default_str();
  command.add_option("--height", o.height_m, "stature, meters")
      ->check(between(0.4, 2.6))
      ->excludes("BODY")
      ->group(group)
      ->capture_default_str();
  command.add_option("--mass", o.mass_kg, "kilograms (default: 62 at 1.68 m, by the square of the height)")
      ->check(above_zero())
      ->excludes("BODY")
      ->group(group);
  command
      .add_option("--pose", o.pose,
                  "a, t, arms-down, arms-up, stride, sit, squat, run, kick, lying, handstand, random")
      ->check(CLI::IsMember(keys(kPoses)))
      ->excludes("BODY")
      ->group(group)
      ->capture_default_str();
  command.add_option("--vertices", o.vertices, "resolution of the skin")
      ->check(whole(1350, 4'000'000))
      ->excludes("BODY")
      ->group(group)
      ->capture_default_str();
}

void add_run_options(CLI::App& command, CommonOptions& o) {
  command.add_option("--threads", o.threads, "workers; 0: one a core")
      ->check(whole(0, 1024))
      ->capture_default_str();
  command
      .add_option(
          "--seed", o.seed,
          "varies the built-in body (0: the average), its pose `random` and gusts; a fit draws nothing "
          "from it and repeats to the bit")
      ->check(whole(0, std::numeric_limits<std::uint64_t>::max()).description(""))
      ->capture_default_str();
  command.add_flag("-q,--quiet", o.quiet, "print nothing but errors");
}

CLI::Option* add_body_option(CLI::App& command, CommonOptions& o, const std::string& help) {
  return command
      .add_option("BODY", o.body,
                  help + ": " + std::string(io::kMeshFormats) + " (default: the built-in body)")
      ->check(not_empty("leave it out for the built-in body"));
}

void add_common_options(CLI::App& command, CommonOptions& o) {
  add_body_option(command, o, "body mesh");
  add_fit_options(command, o);
  add_input_options(command, o);
  add_builtin_options(command, o);
  add_output_options(command, o);
  add_run_options(command, o);
}

engine::Result<tryon::SegmentOptions> segment_options(const CommonOptions& o) {
  tryon::SegmentOptions options;
  options.import.unit = kUnits.at(o.unit);
  if (o.up != "auto") options.import.up = static_cast<geometry::Axis>(o.up[0] - 'x');
  if (!o.mesh.empty()) options.import.mesh = o.mesh;
  options.import.person = o.person;
  options.import.keep_noise = o.keep_noise;
  options.import.keep_vertices = o.keep_vertices;
  if (o.shape == "any") options.import.shape = io::Shape::kAny;
  options.force = o.force;
  auto profile = proportions(o);
  if (!profile) return std::move(profile).error();
  options.profile = std::move(profile).value();
  return options;
}

engine::Result<synth::BodyOptions> builtin_body(const CommonOptions& o) {
  auto profile = proportions(o);
  if (!profile) return std::move(profile).error();
  synth::BodyOptions options;
  options.sex = o.sex == "male" ? body::Sex::kMale : body::Sex::kFemale;
  options.stature_m = o.height_m;
  const double of_usual = options.stature_m / synth::BodyOptions{}.stature_m;
  options.mass_kg = o.mass_kg.value_or(synth::BodyOptions{}.mass_kg * of_usual * of_usual);
  options.pose = kPoses.at(o.pose);
  options.vertices = o.vertices;
  options.seed = o.seed;
  options.profile = std::move(profile).value();
  return options;
}

fitting::FitOptions fit_options(const CommonOptions& o) {
  auto meters = [](std::optional<double> mm) { return mm ? std::optional(*mm * 1e-3) : std::nullopt; };
  fitting::FitOptions options;
  if (!o.tier.empty()) options.tier = *proxy::tier_from_name(o.tier);
  options.target_error_m = meters(o.target_error_mm);
  options.max_ellipsoids = o.max_ellipsoids;
  options.budget_us = o.budget_us;
  options.mu_torso_m = meters(o.mu_torso_mm);
  options.mu_limbs_m = meters(o.mu_limbs_mm);
  options.time_budget_s = o.time_budget_s;
  return options;
}

}  // namespace bodice::cli
