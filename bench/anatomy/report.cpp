#include "report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <numeric>

namespace bench {
namespace {

constexpr double kMeanAgreement = 0.975, kLeastAgreement = 0.93, kMostSwapped = 0.001;

bool misses(const Score& s, double bar) {
  return (s.agreement >= 0.0 && s.agreement < kLeastAgreement) || s.swapped > kMostSwapped ||
         s.worst_landmark > bar;
}

std::string without_side(const std::string& landmark) {
  const bool sided = landmark.ends_with("_l") || landmark.ends_with("_r");
  return sided ? landmark.substr(0, landmark.size() - 2) : landmark;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(values.size(), 1));
}

void print_errors(const char* pose, double bar, std::vector<double> errors) {
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  const auto over = errors.end() - std::upper_bound(errors.begin(), errors.end(), bar);
  std::printf("  %-5s mean %5.2f  p95 %5.2f  worst %5.2f  bar %.1f  over it %3td of %zu", pose,
              100.0 * mean(errors), 100.0 * errors[errors.size() * 95 / 100], 100.0 * errors.back(),
              100.0 * bar, over, errors.size());
}

/// Of a share; a dash where the truth is not known.
std::string percent(double share) {
  if (share < 0.0) return "-";
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.2f", 100.0 * share);
  return text.data();
}

struct Bin {
  double from, to;
};
constexpr Bin kBins[] = {{0.0, 0.25}, {0.25, 0.5}, {0.5, 0.7}, {0.7, 0.8}, {0.8, 0.9}, {0.9, 1.001}};

}  // namespace

void Report::claim(const Case& c, const Score& s, const bodice::anatomy::Anatomy& a) {
  const double bar = c.rest ? kRestBar : kPosedBar;
  kinds_[c.kind].push_back(s.agreement);
  std::map<std::string, bool> over;
  for (const auto& mark : a.landmarks) {
    const auto error = s.error.find(std::string(bodice::body::name(mark.id)));
    if (error == s.error.end()) continue;
    claims_.push_back({mark.confidence, error->second / bar});
    if (error->second > bar) over[without_side(error->first)] = true;
  }
  for (const auto& [name, yes] : over) misses_[c.kind][name] += yes;
}

void Report::print_claims() const {
  std::printf("what a confidence is worth (all landmarks):\n%12s %8s %10s %10s\n", "confidence", "count",
              "mean/bar", "over bar %");
  for (const Bin& bin : kBins) {
    double sum = 0.0;
    std::size_t count = 0, over = 0;
    for (const Claim& claim : claims_) {
      if (!(claim.confidence >= bin.from && claim.confidence < bin.to)) continue;
      ++count;
      sum += claim.error_of_bar;
      over += claim.error_of_bar > 1.0;
    }
    if (count == 0) continue;
    const auto n = static_cast<double>(count);
    std::printf("  %.2f - %.2f %7zu %10.2f %10.1f\n", bin.from, std::min(bin.to, 1.0), count, sum / n,
                100.0 * static_cast<double>(over) / n);
  }
}

void Report::print_kinds() const {
  std::printf("by kind: bodies, their agreement, and how many are over a landmark's bar:\n%-14s %6s %6s %6s",
              "", "bodies", "mean%", "least%");
  for (const auto& [landmark, e] : errors_) std::printf(" %9s", landmark.c_str());
  std::printf("\n");
  for (const auto& [kind, all] : kinds_) {
    std::vector<double> known;
    std::copy_if(all.begin(), all.end(), std::back_inserter(known), [](double a) { return a >= 0.0; });
    const double least = known.empty() ? -1.0 : *std::min_element(known.begin(), known.end());
    std::printf("%-14s %6zu %6s %6s", kind.c_str(), all.size(),
                percent(known.empty() ? -1.0 : mean(known)).c_str(), percent(least).c_str());
    const auto row = misses_.find(kind);
    for (const auto& [landmark, e] : errors_) {
      const bool any = row != misses_.end() && row->second.contains(landmark);
      std::printf(" %9d", any ? row->second.at(landmark) : 0);
    }
    std::printf("\n");
  }
}

void Report::header() const {
  std::printf("%-42s %7s %7s %6s %6s %-12s %6s %7s\n", "body", "V", "agree%", "swap%", "worst%", "landmark",
              "height%", "ms");
}

void Report::add(const Case& c, const bodice::anatomy::Anatomy& a) {
  const Score s = score(c, a);
  const bool missed = misses(s, c.rest ? kRestBar : kPosedBar);
  ++bodies_;
  missed_ += missed;
  missed_silently_ += missed && a.warnings.empty();
  if (s.agreement >= 0.0) agreement_.push_back(s.agreement);
  worst_swap_ = std::max(worst_swap_, s.swapped);
  for (const auto& [name, error] : s.error) {
    Errors& e = errors_[without_side(name)];
    (c.rest ? e.rest : e.posed).push_back(error);
  }
  claim(c, s, a);
  if (!every_row_ && !missed) return;
  double ms = 0.0;
  for (const auto& stage : a.stages) ms += stage.ms;
  std::printf("%-42s %7zu %7s %6.2f %6s %-12s %6s %7.2f", c.name.c_str(), c.mesh.positions.size(),
              percent(s.agreement).c_str(), 100.0 * s.swapped, percent(s.worst_landmark).c_str(),
              s.worst_name.c_str(), percent(s.stature_ratio).c_str(), ms);
  for (const auto& w : a.warnings) std::printf(" %s(%s)", w.code.c_str(), w.part.c_str());
  std::printf("\n");
  if (!every_landmark_) return;
  for (const auto& [name, error] : s.error) std::printf("    %s %.2f", name.c_str(), 100.0 * error);
  std::printf("\n");
}

void Report::add_refused(const Case& c, const std::string& sentence) {
  ++bodies_;
  ++refused_;
  std::printf("%-42s %s\n", c.name.c_str(), sentence.c_str());
}

void Report::summary() const {
  if (bodies_ == 0) return;
  std::printf("\nbodies %d, refused %d, with a bar missed %d, of them without a warning %d\n", bodies_,
              refused_, missed_, missed_silently_);
  if (!agreement_.empty())
    std::printf(
        "agreement, %% of the skin: mean %.2f (bar %.1f), least %.2f (bar %.0f); swapped %.2f (bar 0)\n",
        100.0 * mean(agreement_), 100.0 * kMeanAgreement,
        100.0 * *std::min_element(agreement_.begin(), agreement_.end()), 100.0 * kLeastAgreement,
        100.0 * worst_swap_);
  std::printf("landmarks, %% of the stature from the truth:\n");
  for (const auto& [name, e] : errors_) {
    std::printf("%-10s", name.c_str());
    print_errors("rest", kRestBar, e.rest);
    print_errors("posed", kPosedBar, e.posed);
    std::printf("\n");
  }
  print_kinds();
  print_claims();
}

}  // namespace bench
