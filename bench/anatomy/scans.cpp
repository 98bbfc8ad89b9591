#include "scans.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include <bodice/synth/scan.hpp>

#include "scan_judge.hpp"
#include "scan_subjects.hpp"
#include "sheet.hpp"

namespace bench {
namespace {

using bodice::geometry::Vec3;
using bodice::synth::Scan;
using bodice::synth::ScanKind;

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

std::filesystem::path folder_of(const ScanBench& bench) {
  const auto folder = bench.folder.empty() ? std::filesystem::temp_directory_path() /
                                                 ("bodice_scans_" + std::to_string(getpid()))
                                           : std::filesystem::path(bench.folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// A scan of a real body where there is data, else of a made one.
std::optional<Scan> make(const std::optional<RealSubjects>& real, ScanKind kind, std::uint64_t seed) {
  std::optional<Scan> made;
  if (real) {
    auto subjects = real->of(kind, seed);
    if (!subjects) return made;
    if (auto scan = bodice::synth::make_scan({}, kind, seed, std::move(*subjects))) made = std::move(*scan);
  } else if (auto scan = bodice::synth::make_scan({}, kind, seed)) {
    made = std::move(*scan);
  }
  return made;
}

/// The outcomes of a kind.
struct Row {
  std::array<int, kOutcomes> count{};
  double slowest_s = 0.0, sum_seen_m = 0.0, sum_proxy_m = 0.0;
  int read = 0, fitted = 0;

  void add(const Judged& judged, double took_s) {
    ++count[judged.outcome];
    slowest_s = std::max(slowest_s, took_s);
    read += judged.anatomy ? 1 : 0;
    sum_seen_m += judged.seen_m;
    fitted += judged.proxy_m ? 1 : 0;
    sum_proxy_m += judged.proxy_m.value_or(0.0);
  }

  void print(const std::string& name) const {
    std::printf("%-16s", name.c_str());
    for (const int n : count) std::printf(" %13d", n);
    std::printf(" %13.1f %9.1f", slowest_s, read > 0 ? 1e3 * sum_seen_m / read : 0.0);
    if (fitted > 0) std::printf(" %9.2f", 1e3 * sum_proxy_m / fitted);
    std::printf("\n");
    std::fflush(stdout);
  }
};

void print_line(const std::string& name, std::uint64_t seed, const Judged& judged, double took_s) {
  std::printf("  %-14s %3d %-13s stature %4.1f landmark %4.1f %-11s foreign %4.1f missing %4.1f %% %4.1f s  ",
              name.c_str(), static_cast<int>(seed), kOutcomeNames[judged.outcome], 100 * judged.stature,
              100 * judged.landmark, judged.worst.c_str(), 100 * judged.foreign, 100 * judged.missing,
              took_s);
  if (judged.proxy_m) std::printf("proxy %.2f mm  ", 1e3 * *judged.proxy_m);
  std::printf("%s\n", judged.text.c_str());
  std::fflush(stdout);
}

}  // namespace

bool print_scans(const ScanBench& bench) {
  const std::filesystem::path folder = folder_of(bench);
  std::optional<RealSubjects> real;
  if (!bench.data.empty()) real.emplace(bench.data);
  std::printf("%-16s", "kind");
  for (const char* name : kOutcomeNames) std::printf(" %13s", name);
  std::printf(" %13s %9s%s\n", "slowest s", "skin mm", bench.proxies ? "  proxy mm" : "");
  Row total;
  Sheet sheet;
  for (int k = 0; k < bodice::synth::kScanKindCount; ++k) {
    const auto kind = static_cast<ScanKind>(k);
    const std::string name(bodice::synth::name(kind));
    if (name.find(bench.only) == std::string::npos) continue;
    Row row;
    for (std::uint64_t seed = bench.from; seed < bench.from + bench.count; ++seed) {
      const auto scan = make(real, kind, seed);
      if (!scan) continue;
      const auto file =
          folder / (bench.folder.empty() ? "scan.obj" : name + " " + std::to_string(seed) + ".obj");
      write(*scan, file);
      const auto begin = std::chrono::steady_clock::now();
      const Judged judged = judge(*scan, file, bench.proxies);
      const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      row.add(judged, took_s);
      total.add(judged, took_s);
      if (bench.verbose) print_line(name, seed, judged, took_s);
      if (judged.anatomy) sheet.add(judged.skin, *judged.anatomy);
    }
    row.print(name);
  }
  total.print("all");
  return bench.picture.empty() || sheet.write(bench.picture);
}

}  // namespace bench
