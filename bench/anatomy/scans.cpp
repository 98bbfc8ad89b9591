#include "scans.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/io/import.hpp>
#include <bodice/synth/scan.hpp>

namespace bench {
namespace {

using bodice::anatomy::Anatomy;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;
using bodice::synth::Scan;
using bodice::synth::ScanKind;

/// What is right: stature and landmarks, beyond the error on the clean body, and how much of the skin is
/// something else; all but the last are fractions of the stature.
constexpr double kStature = 0.015, kLandmark = 0.03, kForeign = 0.03;
/// What is absurd.
constexpr double kAbsurdStature = 0.2, kAbsurdForeign = 0.2;
/// A point this far from the body's skin belongs to something else.
constexpr double kElsewhere_m = 0.05;

enum Outcome { kRight, kDoubted, kWarned, kRefused, kSilent, kAbsurd, kOutcomes };
constexpr std::array<const char*, kOutcomes> kOutcomeNames = {"right",   "doubts", "wrong, warned",
                                                              "refused", "silent", "absurd"};

/// The landmarks that tests hold bars on; those of tailors are less certain.
constexpr int kMainLandmarks = 13;

struct Judged {
  Outcome outcome = kRefused;
  double stature = 0.0, landmark = 0.0, foreign = 0.0;  ///< errors
  std::string text;                                     ///< the refusal, or the codes of the warnings
};

void write(const Scan& scan, const std::filesystem::path& file) {
  std::ofstream out(file);
  std::size_t first = 1;
  char line[96];
  for (const auto& mesh : scan.meshes) {
    out << "o " << mesh.name << '\n';
    for (const Vec3& p : mesh.shape.positions) {
      std::snprintf(line, sizeof line, "v %.7g %.7g %.7g\n", p.x(), p.y(), p.z());
      out << line;
    }
    for (const auto& t : mesh.shape.triangles)
      out << "f " << t[0] + first << ' ' << t[1] + first << ' ' << t[2] + first << '\n';
    first += mesh.shape.positions.size();
  }
}

/// The largest error of the main landmarks, of the stature.
double landmark_error(const Anatomy& anatomy, const Scan& scan, int landmark) {
  return (anatomy.landmarks[landmark].position - scan.landmarks[landmark].position).norm() / scan.stature_m;
}

/// The share of a skin that lies away from the body.
double foreign_share(const TriMesh& skin, const TriMesh& body) {
  const bodice::geometry::MeshDistance distance({}, body);
  double all = 0.0, away = 0.0;
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    const double area = area_vector(skin, t).norm();
    const Vec3 middle = (skin.corner(t, 0) + skin.corner(t, 1) + skin.corner(t, 2)) / 3.0;
    all += area;
    if (!distance.closest_point_within(middle, kElsewhere_m)) away += area;
  }
  return all > 0.0 ? away / all : 1.0;
}

/// Warnings that do not doubt the result: they count what was found, or speak of unit and position.
bool is_doubt(const std::string& code) {
  static const std::set<std::string> kNoDoubts = {
      "holes",        "open-edges", "extra-pieces",      "pieces-left-out", "body-joined",
      "non-manifold", "fins",       "unit-contradicted", "degenerate",      "welded",
      "flipped",      "inverted",   "far-from-origin"};
  return !kNoDoubts.contains(code);
}

bodice::anatomy::Options profile() {
  return {bodice::body::find_profile("ansur2").value()};
}

Judged judge(const Scan& scan, const std::filesystem::path& file) {
  Judged judged;
  auto body = bodice::io::import_body({}, file);
  if (!body) return judged.text = body.error().sentence(), judged;
  auto anatomy = bodice::anatomy::analyze({}, body->skin, profile());
  if (!anatomy) return judged.text = anatomy.error().sentence(), judged;
  // The truth has the file's true frame; whether that was found is not in question here.
  const auto to_truth = [&](Vec3& p) { p = scan.frame.to_inside(body->frame.to_file(p)); };
  for (Vec3& p : body->skin.positions) to_truth(p);
  for (auto& mark : anatomy->landmarks) to_truth(mark.position);
  const auto clean = bodice::anatomy::analyze({}, scan.body, profile());
  const auto stature_error = [&](const Anatomy& found) {
    return std::abs(found.stature_m / scan.stature_m - 1.0);
  };
  judged.stature = std::max(0.0, stature_error(*anatomy) - (clean ? stature_error(*clean) : 0.0));
  for (int i = 0; i < kMainLandmarks; ++i)
    judged.landmark = std::max(
        judged.landmark, landmark_error(*anatomy, scan, i) - (clean ? landmark_error(*clean, scan, i) : 0.0));
  judged.foreign = foreign_share(body->skin, scan.body);
  bool doubted = false;
  for (const auto* warnings : {&body->warnings, &anatomy->warnings})
    for (const auto& warning : *warnings) {
      doubted |= is_doubt(warning.code);
      judged.text += (judged.text.empty() ? "" : " ") + warning.code;
    }
  const bool absurd = judged.stature > kAbsurdStature || judged.foreign > kAbsurdForeign;
  const bool right = judged.stature < kStature && judged.landmark < kLandmark && judged.foreign < kForeign;
  judged.outcome = right ? (doubted ? kDoubted : kRight) : absurd ? kAbsurd : doubted ? kWarned : kSilent;
  return judged;
}

std::filesystem::path folder_of(const ScanBench& bench) {
  const auto folder = bench.folder.empty() ? std::filesystem::temp_directory_path() / "bodice_scans"
                                           : std::filesystem::path(bench.folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

void print_scans(const ScanBench& bench) {
  const std::filesystem::path folder = folder_of(bench);
  std::printf("%-16s", "kind");
  for (const char* name : kOutcomeNames) std::printf(" %13s", name);
  std::printf(" %13s\n", "slowest s");
  std::array<int, kOutcomes> total{};
  for (int k = 0; k < bodice::synth::kScanKindCount; ++k) {
    const auto kind = static_cast<ScanKind>(k);
    const std::string name(bodice::synth::name(kind));
    if (name.find(bench.only) == std::string::npos) continue;
    std::array<int, kOutcomes> row{};
    double slowest_s = 0.0;
    for (std::uint64_t seed = bench.from; seed < bench.from + bench.count; ++seed) {
      const auto scan = bodice::synth::make_scan({}, kind, seed);
      if (!scan) continue;
      const auto file =
          folder / (bench.folder.empty() ? "scan.obj" : name + " " + std::to_string(seed) + ".obj");
      write(*scan, file);
      const auto begin = std::chrono::steady_clock::now();
      const Judged judged = judge(*scan, file);
      const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      slowest_s = std::max(slowest_s, took_s);
      ++row[judged.outcome];
      ++total[judged.outcome];
      if (bench.verbose)
        std::printf("  %-14s %3d %-13s stature %5.1f %% landmark %5.1f %% foreign %5.1f %% %4.1f s  %s\n",
                    name.c_str(), static_cast<int>(seed), kOutcomeNames[judged.outcome], 100 * judged.stature,
                    100 * judged.landmark, 100 * judged.foreign, took_s, judged.text.c_str());
    }
    std::printf("%-16s", name.c_str());
    for (const int count : row) std::printf(" %13d", count);
    std::printf(" %13.1f\n", slowest_s);
    std::fflush(stdout);
  }
  std::printf("%-16s", "all");
  for (const int count : total) std::printf(" %13d", count);
  std::printf("\n");
}

}  // namespace bench
